#include "clackers/exact/quantities/conditioning.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "clackers/base/error.hpp"

namespace clackers::exact {
namespace {

double slow_over_fast(const FrequencyRatio& ratio, double r) {
  return ratio.exchanged ? 1.0 / r : r;
}

// Collisions until `size` has grown to lost_synchrony, the logarithm growing by `rate` at each.
double collisions_at(double size, double rate) {
  if (size >= lost_synchrony) return 0.0;
  if (rate == 0.0) return std::numeric_limits<double>::infinity();
  return std::ceil(std::log(lost_synchrony / size) / rate);
}

void require_share(const char* name, double given, double size) {
  if (!(size > 0.0 && size < 1.0))
    refuse("conditioning", name, given, "a size between 0 and 1, both excluded");
}

}  // namespace

double detuning_rate(const FrequencyRatio& ratio, double r) {
  const double q = slow_over_fast(ratio, r), X = ratio.odd;
  if (X == 1.0 || q <= 1.0) return 0.0;
  return std::numbers::pi * std::sqrt((q - 1.0) * (X - q) * (X + q) / std::pow(1.0 + q, 3));
}

Conditioning conditioning(const FrequencyRatio& ratio, double r, double eta) {
  if (eta < 1.0) return Conditioning::growing;
  return detuning_rate(ratio, r) > 0.0 ? Conditioning::detuning_fragile : Conditioning::neutral;
}

double collisions_until_perturbation(double eta, double size) {
  require_share("perturbation", size, size);
  return collisions_at(size, -std::log(eta));
}

double collisions_until_detuning(const FrequencyRatio& ratio, double r, double eta, double eps) {
  const double size = std::abs(eps);
  require_share("detuning", eps, size);
  return collisions_at(size, eta < 1.0 ? -std::log(eta) : detuning_rate(ratio, r) * size);
}

}  // namespace clackers::exact
