#include "clackers/exact/quantities/quantities.hpp"

#include <cmath>
#include <numbers>

#include "clackers/base/error.hpp"

namespace clackers::exact {

double harmonic_amplitude(double odd, double n) {
  if (!(n >= 0.0 && n <= 1e15) || n != std::floor(n))
    refuse("harmonics", "n", n, "a whole number, 0 <= n <= 1e15");
  if (n == 0.0) return 2.0 / (std::numbers::pi * odd);
  // Both factors are whole numbers below 2^53, hence exact.
  return 4.0 / std::numbers::pi * odd / std::abs(odd - 2.0 * n) / (odd + 2.0 * n);
}

double peak_harmonic(double odd) { return odd == 1.0 ? 1.0 : (odd - 1.0) / 2.0; }

}  // namespace clackers::exact
