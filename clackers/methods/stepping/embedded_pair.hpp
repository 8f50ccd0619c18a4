#pragma once

#include <array>
#include <cstddef>

namespace clackers::methods {

/// An explicit Runge-Kutta method on x' = F(t, x) with error estimate and dense output:
///
///     k_i = F(t0 + c_i h, x0 + h sum_j a_ij k_j),  i < stages;  x1 = x0 + h sum_j a_sj k_j,
///     k_s = F(t0 + h, x1),  s = stages, is k_0 of the next step
///     e = h sum_j error_j k_j;  e3 likewise by error_3
///
/// In the step, with r = (t - t0)/h,
///
///     x(t) = x0 + r (d_0 + (1 - r) (d_1 + r (d_2 + (1 - r) (d_3 + ...))))
///     d_0 = x1 - x0,  d_1 = h k_0 - d_0,  d_2 = 2 d_0 - h (k_0 + k_s),  d_(3+m) = h sum_j dense_mj k_j
///
/// where more stages, after k_s, may serve the dense output alone.
struct EmbeddedPair {
  static constexpr std::size_t most = 16;  ///< stages of all kinds
  using Row = std::array<double, most>;

  int stages = 0, dense_stages = 0;
  double order = 0.0, dense_order = 0.0;
  int error_order = 0;  ///< of the power of h that the estimate falls with
  std::array<Row, most> a{};
  Row error{}, error_3{};  ///< error_3 = 0: there is none
  int dense_rows = 0;
  std::array<Row, 4> dense{};

  constexpr double c(std::size_t i) const {
    double sum = 0.0;
    for (const double x : a[i]) sum += x;
    return sum;
  }
};

}  // namespace clackers::methods
