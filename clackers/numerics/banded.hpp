#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace clackers::numerics {

/// The largest |i - j| of an entry that is not 0.
inline Eigen::Index half_bandwidth(const Eigen::MatrixXd& a) {
  Eigen::Index width = 0;
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (Eigen::Index i = 0; i + width < j; ++i)
      if (a(i, j) != 0.0) width = j - i;
    for (Eigen::Index i = a.rows() - 1; i > j + width; --i)
      if (a(i, j) != 0.0) width = i - j;
  }
  return width;
}

/// Whether a matrix is worth being treated as a band.
inline bool is_banded(Eigen::Index size, Eigen::Index half_width) {
  return 8 * (half_width + 1) <= size;
}

/// A matrix for products with vectors, of any size by its diagonals where it is a narrow band.
template <int Dof>
class BandedMatrix {
 public:
  using Matrix = Eigen::Matrix<double, Dof, Dof>;
  using Vector = Eigen::Matrix<double, Dof, 1>;

  BandedMatrix& operator=(const Matrix& a) {
    a_ = a;
    if constexpr (Dof == Eigen::Dynamic) {
      const auto n = a.rows(), width = half_bandwidth(a);
      width_ = is_banded(n, width) ? width : -1;
      diagonals_.setZero(n, 2 * width_ + 1 > 0 ? 2 * width_ + 1 : 0);
      for (Eigen::Index k = -width_; k <= width_; ++k)
        diagonals_.col(width_ + k).head(n - std::abs(k)) = a.diagonal(k);
    }
    return *this;
  }

  const Matrix& matrix() const { return a_; }
  /// Largest |i - j| of its entries; -1 where it is no narrow band.
  Eigen::Index width() const { return width_; }
  /// Entries (i, i - k) of the k-th diagonal below the main one; k at most the width.
  auto below(Eigen::Index k) const {
    return diagonals_.col(width_ - k).head(diagonals_.rows() - k);
  }

  /// to += A x
  void add_product(const Vector& x, Vector& to) const {
    if (!by_diagonals([&](auto&& y, auto&& d, auto&& z) { y += d.cwiseProduct(z); }, x, to))
      to.noalias() += a_ * x;
  }
  /// to -= A x
  void subtract_product(const Vector& x, Vector& to) const {
    if (!by_diagonals([&](auto&& y, auto&& d, auto&& z) { y -= d.cwiseProduct(z); }, x, to))
      to.noalias() -= a_ * x;
  }

 private:
  bool by_diagonals(const auto& act, const Vector& x, Vector& to) const {
    if constexpr (Dof == Eigen::Dynamic) {
      if (width_ < 0) return false;
      for (Eigen::Index k = -width_; k <= width_; ++k) {
        const auto n = x.size() - std::abs(k);
        act(to.segment(std::max(-k, Eigen::Index(0)), n), diagonals_.col(width_ + k).head(n),
            x.segment(std::max(k, Eigen::Index(0)), n));
      }
      return true;
    }
    return false;
  }

  Matrix a_;
  Eigen::MatrixXd diagonals_;
  Eigen::Index width_ = -1;
};

}  // namespace clackers::numerics
