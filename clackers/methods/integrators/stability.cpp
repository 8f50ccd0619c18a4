#include "clackers/methods/integrators/stability.hpp"

#include <cmath>

namespace clackers::methods {

double spectral_radius(double trace, double determinant) {
  const double half = 0.5 * trace, under_root = half * half - determinant;
  return under_root > 0.0 ? std::abs(half) + std::sqrt(under_root) : std::sqrt(determinant);
}

}  // namespace clackers::methods
