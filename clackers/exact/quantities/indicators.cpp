#include "clackers/exact/quantities/indicators.hpp"

#include <cmath>
#include <numbers>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/wide.hpp"

namespace clackers::exact {
namespace {

// The largest n whose harmonic 2 n Omega, |a_n| = (4X/pi) / |X^2 - 4 n^2|, reaches eps of the peak.
// The peak is at 2n = X - 1 where |X^2 - 4 n^2| = 2X - 1, and for X = 1 taken at n = 1 where it
// is 3.
double highest_harmonic(double odd, double eps) {
  const Wide X = odd;
  const Wide at_peak = odd == 1.0 ? Wide(3) : 2 * X - 1;
  Wide n = floor(sqrt(X * X + at_peak / eps) / 2);
  // The root is rounded, these products are exact.
  const auto counts = [&](const Wide& m) { return (4 * m * m - X * X) * eps <= at_peak; };
  while (!counts(n)) n -= 1;
  while (counts(n + 1)) n += 1;
  return to_double(n);
}

}  // namespace

Indicators indicators(double odd, double omega, double end, double threshold) {
  if (!(threshold > 0.0 && threshold < 1.0))
    refuse("indicators", "threshold", threshold,
           "0 < threshold < 1, a fraction of the spectral peak");
  Indicators result;
  result.threshold = threshold;
  result.stiffness_ratio = odd;
  result.longest_period = std::numbers::pi / omega;
  result.highest_harmonic = highest_harmonic(odd, threshold);
  result.shortest_period = std::numbers::pi / (result.highest_harmonic * omega);
  result.oscillations = end / result.shortest_period;
  result.bound_holds = result.stiffness_ratio >= result.highest_harmonic;
  return result;
}

}  // namespace clackers::exact
