#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <type_traits>

#include "clackers/numerics/banded.hpp"

namespace clackers::numerics {

/// Solves A x = b for a symmetric positive definite A, many times for one A. Hides one decision:
/// an inverse for the one or two unknowns known at compile time, a Cholesky factorization
/// otherwise, within the band where A has a narrow one. Only the lower triangle of A is read. After the first compute() of a size nothing
/// is allocated.
template <int Dof>
class SpdSolver {
  static_assert(Dof == 1 || Dof == 2 || Dof == Eigen::Dynamic);

 public:
  using Index = Eigen::Index;
  using Matrix = Eigen::Matrix<double, Dof, Dof>;

  /// Takes A in; false, and nothing to solve with, unless A is positive definite and finite.
  bool compute(const Matrix& a) {
    if constexpr (Dof == 1) {
      solver_(0, 0) = 1.0 / a(0, 0);
      return a(0, 0) > 0.0 && std::isfinite(a(0, 0));
    } else if constexpr (Dof == 2) {
      const double determinant = a(0, 0) * a(1, 1) - a(1, 0) * a(1, 0);
      const double scale = 1.0 / determinant;
      solver_(0, 0) = scale * a(1, 1);
      solver_(1, 1) = scale * a(0, 0);
      solver_(0, 1) = solver_(1, 0) = -scale * a(1, 0);
      return a(0, 0) > 0.0 && determinant > 0.0 && std::isfinite(determinant);
    } else {
      width_ = half_bandwidth(a);
      if (is_banded(a.rows(), width_)) {
        band_.setZero(width_ + 1, a.rows());
        for (Index k = 0; k <= width_; ++k) below(k) = a.diagonal(-k);
        return factorize_band();
      }
      width_ = -1;
      solver_.compute(a);
      return solver_.info() == Eigen::Success && solver_.matrixLLT().diagonal().allFinite();
    }
  }

  /// A matrix and its factor in a sum.
  struct Term {
    double factor;
    const BandedMatrix<Dof>& matrix;
  };
  /// The same of a sum: within the band alone where all of its matrices are narrow ones, else `whole`
  /// becomes it.
  bool compute(std::initializer_list<Term> sum, Matrix& whole) {
    if constexpr (Dof == Eigen::Dynamic) {
      const auto is_band = [](const Term& term) { return term.matrix.width() >= 0; };
      if (std::ranges::all_of(sum, is_band)) {
        width_ = 0;
        for (const auto& term : sum) width_ = std::max(width_, term.matrix.width());
        band_.setZero(width_ + 1, whole.rows());
        for (const auto& term : sum)
          for (Index k = 0; k <= term.matrix.width(); ++k)
            below(k) += term.factor * term.matrix.below(k);
        return factorize_band();
      }
    }
    whole.setZero();
    for (const auto& term : sum) whole += term.factor * term.matrix.matrix();
    return compute(whole);
  }

  /// x becomes A^-1 x; x may have several columns.
  template <class Derived>
  void solve_in_place(Eigen::MatrixBase<Derived>& x) const {
    if constexpr (Dof == Eigen::Dynamic)
      width_ < 0 ? solver_.solveInPlace(x) : solve_band(x);
    else
      x = (solver_ * x).eval();
  }

 private:
  auto below(Index k) { return band_.row(k).tail(band_.cols() - k).transpose(); }

  // band_(k, i) = A(i, i - k) becomes L(i, i - k), and 1/L(i, i) for k = 0.
  bool factorize_band() {
    for (Index i = 0; i < band_.cols(); ++i)
      for (Index j = std::max(i - width_, Index(0)); j <= i; ++j) {
        double sum = band_(i - j, i);
        for (Index k = std::max(i - width_, Index(0)); k < j; ++k)
          sum -= band_(i - k, i) * band_(j - k, j);
        if (j < i) {
          band_(i - j, i) = sum * band_(0, j);
        } else {
          if (!(sum > 0.0 && std::isfinite(sum))) return false;
          band_(0, i) = 1.0 / std::sqrt(sum);
        }
      }
    return true;
  }

  template <class Derived>
  void solve_band(Eigen::MatrixBase<Derived>& x) const {
    const Index n = band_.cols();
    for (Index column = 0; column < x.cols(); ++column) {
      auto y = x.col(column);
      for (Index i = 0; i < n; ++i) {
        double sum = y[i];
        for (Index k = std::min(width_, i); k >= 1; --k) sum -= band_(k, i) * y[i - k];
        y[i] = sum * band_(0, i);
      }
      for (Index i = n; i-- > 0;) {
        double sum = y[i];
        for (Index k = std::min(width_, n - 1 - i); k >= 1; --k) sum -= band_(k, i + k) * y[i + k];
        y[i] = sum * band_(0, i);
      }
    }
  }

  std::conditional_t<Dof == Eigen::Dynamic, Eigen::LLT<Matrix>, Matrix> solver_;
  Eigen::MatrixXd band_;
  Index width_ = -1;
};

}  // namespace clackers::numerics
