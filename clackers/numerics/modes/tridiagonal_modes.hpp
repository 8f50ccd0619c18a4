#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "clackers/numerics/double_double.hpp"

namespace clackers::numerics {

/// A symmetric matrix.
struct Tridiagonal {
  std::vector<DoubleDouble> diagonal, off_diagonal;  ///< entries (i, i) and (i, i + 1)
};

/// Modes of undamped vibration, K X = M X diag(squares), X' M X = 1, rounded from numbers that are more
/// accurate than doubles: the error of an entry of a shape is 2^-60 of the shape's size at most.
struct TridiagonalModes {
  /// Of angular frequencies, ascending; those from -64 n epsilon to 2^-80 of the largest are 0.
  Eigen::VectorXd squares;
  Eigen::VectorXd square_errors;  ///< bounds
  Eigen::MatrixXd shapes;
  /// What squares and shapes are more in double-double, and bounds on the errors of that: of shapes in the
  /// norm of M, in which they are 1.
  Eigen::VectorXd squares_rest, rest_errors;
  Eigen::MatrixXd shapes_rest;
  double shape_error = 0.0;
};

/// By Rayleigh quotient iteration in double-double from squares by bisection; a residual r of a mode in the
/// norm of M^-1 is a bound on the error of its square, and r over the distance from the next square one on
/// that of its shape: B. N. Parlett, The Symmetric Eigenvalue Problem, SIAM (1998), chapters 4 and 11.
/// Nothing where squares of joined masses are too close for that, or a row of M has a diagonal entry that
/// is not larger than the sum of the others.
std::optional<TridiagonalModes> tridiagonal_modes(const Tridiagonal& stiffness,
                                                  const Tridiagonal& mass);

}  // namespace clackers::numerics
