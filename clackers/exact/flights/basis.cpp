#include "clackers/exact/flights/basis.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::exact {

using Eigen::Index;
using numerics::DoubleDouble;

Basis::Basis(const Matrix& basis) : columns_(basis.cols()), rows_(std::size_t(basis.rows())) {
  for (Index j = 0; j < basis.cols(); ++j)
    for (Index i = 0; i < basis.rows(); ++i)
      if (basis(i, j) != 0.0) rows_[std::size_t(i)].emplace_back(j, basis(i, j));
  same_.resize(std::size_t(columns_));
  for (Index i = 0; i < basis.rows(); ++i)
    if (const auto& row = rows_[std::size_t(i)]; row.size() == 1 && row[0].second == 1.0)
      same_[std::size_t(row[0].first)] = i;
}

bool Basis::is_signed() const {
  return std::ranges::all_of(rows_, [](const auto& row) {
    return row.empty() || (row.size() == 1 && std::abs(row.front().second) == 1.0);
  });
}

Basis::Matrix Basis::times(const Matrix& x) const {
  Matrix y = Matrix::Zero(std::ssize(rows_), x.cols());
  for (Index i = 0; i < y.rows(); ++i)
    for (const auto& [j, entry] : rows_[std::size_t(i)]) y.row(i) += entry * x.row(j);
  return y;
}

Basis::Matrix Basis::transposed(const Matrix& x) const {
  Matrix y = Matrix::Zero(columns_, x.cols());
  for (Index i = 0; i < x.rows(); ++i)
    for (const auto& [j, entry] : rows_[std::size_t(i)]) y.row(j) += entry * x.row(i);
  return y;
}

Basis::Matrix Basis::sizes(Matrix u) const {
  const Matrix all = u;
  for (Index i = 0; i < u.rows(); ++i) {
    u.row(i).setZero();
    for (const auto& [j, entry] : rows_[std::size_t(i)])
      u.row(i) += std::abs(entry) * all.row(same_[std::size_t(j)]);
  }
  return u;
}

Eigen::VectorXd Basis::sizes_transposed(Eigen::VectorXd on_u) const {
  const Eigen::VectorXd all = on_u;
  on_u.setZero();
  for (Index i = 0; i < all.size(); ++i)
    for (const auto& [j, entry] : rows_[std::size_t(i)])
      on_u[same_[std::size_t(j)]] += std::abs(entry) * all[i];
  return on_u;
}

Basis::Matrix Basis::reduced(const Matrix& x) const {
  Matrix y = Matrix::Zero(x.rows(), columns_), z = Matrix::Zero(columns_, columns_);
  for (Index i = 0; i < x.cols(); ++i)
    for (const auto& [j, entry] : rows_[std::size_t(i)]) y.col(j) += entry * x.col(i);
  for (Index i = 0; i < x.rows(); ++i)
    for (const auto& [j, entry] : rows_[std::size_t(i)]) z.row(j) += entry * y.row(i);
  return 0.5 * (z + z.transpose());
}

std::optional<numerics::Tridiagonal> Basis::tridiagonal(const Matrix& x, const Matrix& rest) const {
  const auto n = std::size_t(columns_);
  numerics::Tridiagonal made{std::vector<DoubleDouble>(n),
                             std::vector<DoubleDouble>(n > 0 ? n - 1 : 0)};
  for (Index b = 0; b < x.cols(); ++b)
    for (Index a = 0; a < x.rows(); ++a) {
      const DoubleDouble entry{x(a, b), rest.size() > 0 ? rest(a, b) : 0.0};
      if (entry.hi == 0.0 && entry.lo == 0.0) continue;
      for (const auto& [i, left] : rows_[std::size_t(a)])
        for (const auto& [j, right] : rows_[std::size_t(b)]) {
          if (j < i) continue;
          if (j > i + 1) return std::nullopt;
          auto& to = (i == j ? made.diagonal : made.off_diagonal)[std::size_t(i)];
          to = to + entry * left * right;
        }
    }
  return made;
}

}  // namespace clackers::exact
