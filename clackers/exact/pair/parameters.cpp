#include "clackers/exact/pair/parameters.hpp"

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

void require_damping_ratio(std::string_view who, double xi1) {
  if (xi1 == 0.0 || (xi1 >= smallest_scale && xi1 < 1.0)) return;
  refuse(who, "xi1", xi1, "0 or 1e-60 <= xi1 < 1",
         xi1 >= 1.0  ? "At 1 and beyond mass 1 does not oscillate, so nothing collides again."
         : xi1 > 0.0 ? "Below 1e-60 use 0."
                     : "A negative damping ratio would feed energy in.");
}

void require(std::string_view who, const FreeMassParameters& p) {
  require_damping_ratio(who, p.xi1);
}

void require(std::string_view who, const RigidStopParameters& p) {
  require_damping_ratio(who, p.xi1);
  require_restitution(who, p.eta);
}

void require(std::string_view who, const PairParameters& p) {
  frequency_ratio(who, p.X);
  require_scale(who, "m1", p.m1);
  require_scale(who, "k1", p.k1);
  require_damping_ratio(who, p.xi1);
  require_scale(who, "A", p.A);
  require_scale(who, "r", p.r);
  require_restitution(who, p.eta);
}

void require(std::string_view who, const ExactDataParameters& p) {
  constexpr double smallest = 1e-30, largest = 1e30;
  require_scale(who, "m2", p.m2, smallest, largest);
  require_scale(who, "Omega", p.Omega, smallest, largest);
  if (p.sigma != 0.0) require_scale(who, "sigma", p.sigma, smallest, largest);
  require_scale(who, "A_over_X", p.A_over_X, smallest, largest);
  require_scale(who, "r", p.r, smallest, largest);
  require_restitution(who, p.eta);
  if (frequency_ratio(who, p.X).is_inverse)
    refuse(who, "X", p.X, "an odd whole number",
           "1 over one is no short binary fraction; swap the masses instead.", "not-odd");
}

}  // namespace

void require_restitution(std::string_view who, double eta) {
  if (!(eta >= 0.0 && eta <= 1.0))
    refuse(who, "eta", eta, "0 <= eta <= 1", "0 is perfectly plastic, 1 perfectly elastic.");
}

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

void require_scale(std::string_view who, std::string_view name, double value, double smallest,
                   double largest) {
  if (!(value >= smallest && value <= largest))
    refuse(who, name, value, fmt::format("{} <= {} <= {}", smallest, name, largest),
           value > 0.0 ? "Choose other units; beyond, derived quantities leave double precision."
                       : "It must be positive.");
}

void require_ranges(std::string_view who, const Parameters& parameters) {
  std::visit([who](const auto& p) { require(who, p); }, parameters);
}

}  // namespace clackers::exact
