#include "clackers/exact/quantities/quantities.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/high_precision.hpp"

namespace clackers::exact {
namespace {

// |X^2 - 4 n^2| of the largest harmonic: 2n = X - 1, and n = 1 for X = 1.
double peak_distance(double odd) { return odd == 1.0 ? 3.0 : 2.0 * odd - 1.0; }

// To two decimal digits.
double rounded_up(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1.0);
  return std::ceil(x / unit) * unit;
}

}  // namespace

Indicators indicators(double odd, double omega, double end, double threshold) {
  if (!(threshold > 0.0 && threshold < 1.0))
    refuse("indicators", "threshold", threshold,
           "0 < threshold < 1, a fraction of the spectral peak");
  // Beyond so many harmonics neighbouring frequencies are one double.
  constexpr double most = 5e14;
  const double smallest =
      rounded_up(peak_distance(odd) / ((2.0 * most - odd) * (2.0 * most + odd)));
  if (threshold < smallest * (1.0 - 1e-12))
    refuse("indicators", "threshold", threshold,
           fmt::format("{:.1e} <= threshold < 1 for X = {}", smallest, odd),
           fmt::format("Below it more than {:.0e} harmonics count. Set it by --threshold.", most));
  Indicators result;
  result.threshold = threshold;
  result.stiffness_ratio = odd;
  result.longest_period = std::numbers::pi / omega;
  // The largest n whose amplitude (4X/pi) / |X^2 - 4 n^2| reaches the threshold.
  result.highest_harmonic = highest_harmonic(odd, peak_distance(odd), threshold);
  result.shortest_period = std::numbers::pi / (result.highest_harmonic * omega);
  result.oscillations = end / result.shortest_period;
  result.bound_holds = result.stiffness_ratio >= result.highest_harmonic;
  return result;
}

}  // namespace clackers::exact
