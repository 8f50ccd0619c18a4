#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <type_traits>

namespace clackers::numerics {

/// Solves A x = b for a symmetric positive definite A, many times for one A. Hides one decision:
/// an inverse for the one or two unknowns known at compile time, a Cholesky factorization
/// otherwise. Only the lower triangle of A is read. After the first compute() of a size nothing
/// is allocated.
template <int Dof>
class SpdSolver {
  static_assert(Dof == 1 || Dof == 2 || Dof == Eigen::Dynamic);

 public:
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
      solver_.compute(a);
      return solver_.info() == Eigen::Success && solver_.matrixLLT().diagonal().allFinite();
    }
  }

  /// x becomes A^-1 x; x may have several columns.
  template <class Derived>
  void solve_in_place(Eigen::MatrixBase<Derived>& x) const {
    if constexpr (Dof == Eigen::Dynamic)
      solver_.solveInPlace(x);
    else
      x = (solver_ * x).eval();
  }

 private:
  std::conditional_t<Dof == Eigen::Dynamic, Eigen::LLT<Matrix>, Matrix> solver_;
};

}  // namespace clackers::numerics
