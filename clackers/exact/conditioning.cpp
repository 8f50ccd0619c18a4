#include "clackers/exact/conditioning.hpp"

#include <cmath>
#include <numbers>

namespace clackers::exact {
namespace {

double slow_over_fast(const FrequencyRatio& ratio, double r) {
  return ratio.exchanged ? 1.0 / r : r;
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

}  // namespace clackers::exact
