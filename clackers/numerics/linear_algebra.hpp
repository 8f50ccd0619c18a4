#pragma once

#include <Eigen/Cholesky>
#include <complex>
#include <optional>
#include <span>
#include <vector>

// Eigen's decompositions of matrices of any size, each compiled here alone: instantiating one takes
// a compiler seconds.
namespace clackers::numerics {

/// The inverse by LU with partial pivoting.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);

/// A = L L^T of a symmetric positive definite A.
class Cholesky {
 public:
  explicit Cholesky(const Eigen::MatrixXd& a);

  /// Whether each pivot is more than `rounding` times its diagonal entry of A.
  bool is_definite(const Eigen::MatrixXd& a, double rounding) const;
  /// X of A X = B.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  Eigen::LLT<Eigen::MatrixXd> factors_;
};

/// X of A X = B for a symmetric positive definite A.
Eigen::MatrixXd solved(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// X of A X = B, or the shortest that makes |A X - B| least.
Eigen::MatrixXd shortest_solution(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Columns Z with rows Z = 0 and Z^T M Z = 1, for independent rows and a positive definite M.
Eigen::MatrixXd unseen_directions(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& mass);

/// A X, where the left or the right half of the columns of A often is 0, as for velocities where rows are
/// displacements.
Eigen::MatrixXd product_of_halves(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                  const Eigen::MatrixXd& x);

/// x that makes |A x - b| least, by QR with column pivoting; pivots below `threshold` times the
/// largest count as 0. A negative threshold is Eigen's own.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                              double threshold = -1.0);

/// Modes of undamped vibration: K X = M X diag(squares), X' M X = 1, squares ascending.
struct NormalModes {
  Eigen::VectorXd squares;  ///< of angular frequencies [rad^2/s^2]
  Eigen::MatrixXd shapes;
};
/// Nothing where they are not found. K is symmetric, M positive definite as well.
std::optional<NormalModes> normal_modes(const Eigen::MatrixXd& stiffness,
                                        const Eigen::MatrixXd& mass);
/// The largest of `squares` alone.
double highest_square(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);

/// Ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a);
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);

/// The eigenvalues of an unknown linear map A, from what is seen of its iterates: samples[k] =
/// C A^k X for k = 0, 1, ..., a row an output and a column a start. Eigenvalues that C does not see
/// or X does not excite, relative to the others by more than 1e-10, are not found. By the realization
/// of the smallest dimension: B.-L. Ho, R. E. Kalman, Regelungstechnik 14, 545-548 (1966). Throws
/// InputError for fewer than three samples, for samples of unlike size, and for numbers that are not
/// finite. Empty when all samples are 0.
std::vector<std::complex<double>> eigenvalues_of_iterates(std::span<const Eigen::MatrixXd> samples);

}  // namespace clackers::numerics
