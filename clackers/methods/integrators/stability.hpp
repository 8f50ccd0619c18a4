#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace clackers::methods {

/// The end of the interval of omega h, from 0 on, on which an undamped motion does not grow; 0 if it
/// grows in every step however short. `radius(x)` is the factor of its growth in a step with
/// omega h = x.
double stability_limit(const auto& radius) {
  const auto grows = [&](double x) { return radius(x) > 1.0 + 1e-12; };
  double stable = 0.1;
  if (grows(stable)) return 0.0;
  for (double step = 0.01; step > 1e-12; step *= 0.5)
    while (!grows(stable + step)) stable += step;
  return stable;
}

/// |R(i y)| of  R(z) = 1 + sum_k coefficients_k z^(k+1).
double amplification(const std::vector<double>& coefficients, double y);

/// The limit of an explicit Runge-Kutta method; its coefficients are b A^k 1.
template <class Table, class Weights>
double limit_of(const Table& a, const Weights& b, std::size_t stages) {
  std::vector<double> x(stages, 1.0), coefficients;
  for (std::size_t k = 0; k < stages; ++k) {
    double sum = 0.0;
    std::vector<double> next(stages);
    for (std::size_t i = 0; i < stages; ++i) {
      sum += b[i] * x[i];
      for (std::size_t j = 0; j < stages; ++j) next[i] += a[i][j] * x[j];
    }
    coefficients.push_back(sum);
    x = next;
  }
  return stability_limit([&](double y) { return amplification(coefficients, y); });
}

/// The spectral radius of a real matrix of two rows, by its trace and determinant.
double spectral_radius(double trace, double determinant);

/// The spectral radius of a matrix of three rows: the 2^40-th root of the norm of its 2^40-th power.
double spectral_radius(Eigen::Matrix3d matrix);

}  // namespace clackers::methods
