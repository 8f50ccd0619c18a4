#include "clackers/methods/integrators/stability.hpp"

#include <cmath>

namespace clackers::methods {

double amplification(const std::vector<double>& coefficients, double y) {
  double real = 1.0, imaginary = 0.0, power = 1.0;
  for (std::size_t k = 1; k <= coefficients.size(); ++k) {
    power *= y;
    const double term = k % 4 < 2 ? coefficients[k - 1] * power : -coefficients[k - 1] * power;
    (k % 2 == 0 ? real : imaginary) += term;
  }
  return std::hypot(real, imaginary);
}

double spectral_radius(double trace, double determinant) {
  const double half = 0.5 * trace, under_root = half * half - determinant;
  return under_root > 0.0 ? std::abs(half) + std::sqrt(under_root) : std::sqrt(determinant);
}

double spectral_radius(Eigen::Matrix3d matrix) {
  double logarithm = 0.0, share = 1.0;
  for (int squarings = 0; squarings < 40; ++squarings, share *= 0.5) {
    const double norm = matrix.norm();
    if (norm == 0.0) return 0.0;
    logarithm += share * std::log(norm);
    matrix /= norm;
    matrix = (matrix * matrix).eval();
  }
  return std::exp(logarithm);
}

}  // namespace clackers::methods
