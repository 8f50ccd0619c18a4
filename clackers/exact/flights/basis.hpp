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
  /// Whether each u is 0, or one of q or of -q.
  bool is_signed() const;
  /// basis x
  Matrix times(const Matrix& x) const;
  /// basis' x
  Matrix transposed(const Matrix& x) const;
  /// What sizes of u, those of q where they are one of them, are of the sums |basis| q; and the transpose
  /// of that map.
  Matrix sizes(Matrix u) const;
  Eigen::VectorXd sizes_transposed(Eigen::VectorXd on_u) const;
  /// basis' x basis of a symmetric x.
  Matrix reduced(const Matrix& x) const;
  /// The same of x + rest, if it has three diagonals; an empty rest is 0.
  std::optional<numerics::Tridiagonal> tridiagonal(const Matrix& x, const Matrix& rest = {}) const;

 private:
  Eigen::Index columns_;
  std::vector<std::vector<std::pair<Eigen::Index, double>>> rows_;  // columns and entries
  std::vector<Eigen::Index> same_;                                  // of q_j the u_i that is q_j
};

}  // namespace clackers::exact
