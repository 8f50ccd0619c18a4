#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "clackers/numerics/modes/tridiagonal_modes.hpp"

namespace clackers::exact {

/// The coordinates q that constraints leave, u = basis q: a matrix with few entries that are not 0.
class Basis {
 public:
  using Matrix = Eigen::MatrixXd;

  explicit Basis(const Matrix& basis);

  Eigen::Index columns() const { return columns_; }
  /// basis x
  Matrix times(const Matrix& x) const;
  /// basis' x basis of a symmetric x.
  Matrix reduced(const Matrix& x) const;
  /// The same of x + rest, if it has three diagonals; an empty rest is 0.
  std::optional<numerics::Tridiagonal> tridiagonal(const Matrix& x, const Matrix& rest = {}) const;

 private:
  Eigen::Index columns_;
  std::vector<std::vector<std::pair<Eigen::Index, double>>> rows_;  // columns and entries
};

}  // namespace clackers::exact
