#include "clackers/exact/pair/frequency_ratio.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::exact {
namespace {

bool is_odd(double x) { return std::fmod(x, 2.0) == 1.0; }

// The odd whole numbers around x > 0, in words: "9", "7 or 9".
std::string odd_neighbours(double x) {
  const double below = std::max(1.0, 2.0 * std::floor((x - 1.0) / 2.0) + 1.0);
  return below >= x ? fmt::format("{}", below) : fmt::format("{} or {}", below, below + 2.0);
}

}  // namespace

double quarter_sine(double odd) { return std::fmod(odd, 4.0) == 1.0 ? 1.0 : -1.0; }

FrequencyRatio frequency_ratio(std::string_view who, double X) {
  const auto rule = fmt::format(
      "an odd whole number from 1 to {:.0e} (mass 2 is the faster one), or 1 over one (mass 1 is)",
      largest_ratio);
  if (!(X > 0.0 && std::isfinite(X))) refuse(who, "X", X, rule);
  const double upright = X >= 1.0 ? X : std::round(1.0 / X);
  if (upright > largest_ratio)
    refuse(who, "X", X, rule,
           "Beyond it the phase of the fast mass is not certain to the last digit.");
  if (X >= 1.0 && is_odd(X)) return {X, false};
  if (X < 1.0 && is_odd(upright) && 1.0 / upright == X) return {upright, true};
  refuse(who, "X", X, rule,
         X >= 1.0 ? fmt::format("Nearest: {}.", odd_neighbours(X))
                  : fmt::format("Nearest: 1 over {}; write it with all digits, as {} for 1/3.",
                                odd_neighbours(1.0 / X), 1.0 / 3.0),
         "not-odd");
}

}  // namespace clackers::exact
