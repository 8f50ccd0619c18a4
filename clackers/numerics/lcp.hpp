#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace clackers::numerics {

/// Cholesky factors L D L^T of principal submatrices of a symmetric positive semidefinite matrix.
/// After construction nothing is allocated.
class PrincipalCholesky {
 public:
  /// For submatrices of at most `most` rows.
  explicit PrincipalCholesky(std::size_t most);

  /// Factorizes the rows and columns `rows` of A. Returns how many: all, or those before the first
  /// that depends linearly on them, its pivot being within rounding of 0.
  std::size_t compute(const Eigen::MatrixXd& a, std::span<const std::size_t> rows);
  /// x(0), x(1), ... for the factorized rows become the solution of A x = b.
  void solve_in_place(Eigen::VectorXd& x) const;

 private:
  Eigen::MatrixXd factors_;  // L below the diagonal, D on it
  Eigen::VectorXd products_;
  Eigen::Index count_ = 0;
};

/// Solves linear complementarity problems 0 <= z _|_ w = W z + q >= 0, W symmetric positive
/// semidefinite, by Lemke's pivoting with the lexicographic rule, which cannot cycle. Its rows are
/// scaled by the diagonal of W, and the solution is computed anew from the rows of W where z > 0.
/// It is unique if W is definite; W z and the minimum of z . (W z / 2 + q) are unique in any case.
/// Takes about n pivots of 2 n^2 products. After construction nothing is allocated. Source: R. W.
/// Cottle, J.-S. Pang, R. E. Stone, The Linear Complementarity Problem, SIAM (2009), sections 4.4
/// and 4.9.
class LcpSolver {
 public:
  /// For problems of at most `most` rows.
  explicit LcpSolver(std::size_t most);

  /// Solves the problem of the given rows of W and q; z, of the size of q, becomes 0 in the others.
  /// There z >= 0 holds exactly and the rest within rounding. False where no z has W z + q >= 0, or
  /// rounding hides it; z is then 0.
  bool solve(const Eigen::MatrixXd& w, const Eigen::VectorXd& q, std::span<const std::size_t> rows,
             Eigen::VectorXd& z);

 private:
  bool pivot_to_solution(const Eigen::MatrixXd& w, const Eigen::VectorXd& q,
                         std::span<const std::size_t> rows);
  Eigen::Index leaving_row(Eigen::Index entering) const;
  void pivot(Eigen::Index row, Eigen::Index entering);
  bool is_solution(const Eigen::MatrixXd& w, const Eigen::VectorXd& q,
                   std::span<const std::size_t> rows, const Eigen::VectorXd& z) const;

  Eigen::Index n_ = 0;
  Eigen::MatrixXd table_;            // columns w, z, artificial variable, right-hand side
  std::vector<Eigen::Index> basis_;  // column of the basic variable of each row
  Eigen::VectorXd scale_, values_;
  std::vector<std::size_t> positive_;
  PrincipalCholesky factors_;
};

}  // namespace clackers::numerics
