#include "clackers/exact/pair/admissibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/high_precision.hpp"

namespace clackers::exact {
namespace {

using std::numbers::pi;

// The zero of an increasing function between a point where it is negative and one where it is
// not, to the last bit.
double rising_zero(const auto& f, double below, double above) {
  for (;;) {
    const double middle = below + 0.5 * (above - below);
    if (!(below < middle && middle < above)) return above;
    (f(middle) < 0.0 ? below : above) = middle;
  }
}

// What would happen and what to change; `factor` is r over its limit.
std::string explain(bool grazes, bool is_inverse, double factor, double t, double u) {
  const auto value = grazes ? std::string("exactly on it: the masses would graze")
                            : fmt::format("{:.6g} times it: the masses would {}", factor,
                                          t == 0.0 ? "touch or overlap already" : "touch");
  const auto end = grazes ? "so that no computation can distinguish contact from none"
                          : "and the closed form would not hold";
  return fmt::format(
      "The value is {} at t = {:.6g} s, where u1 = u2 = {:.6g} m, away from equilibrium, {}. "
      "Take r {} the limit, or X = 1, which takes every r.",
      value, t, u, end, is_inverse ? "above" : "below");
}

}  // namespace

double graze_angle(double X) {
  return rising_zero(
      [X](double y) { return X * std::sin(y / X) * std::cos(y) - std::sin(y) * std::cos(y / X); },
      pi, 1.5 * pi);
}

double first_contact_angle(double X, double r) {
  if (X + r * quarter_sine(X) <= 0.0) return 0.0;
  const auto gap = [X, r](double x) { return X * std::sin(x / X) + r * std::sin(x); };
  const auto slope = [X, r](double x) { return std::cos(x / X) + r * std::cos(x); };
  // Going forward in time x falls from X pi/2, so the largest zero counts. Zeros lie in the troughs
  // (pi, 2 pi) + 2 pi j of sin x, where X sin(x/X) <= r, and trough j = (X-5)/4 is the last before
  // the symmetric end (the one at the end itself was looked at above).
  const double reachable = (X * std::asin(std::min(1.0, r / X)) - pi) / (2.0 * pi);
  double j = std::min(std::floor(reachable), std::floor((X - 5.0) / 4.0));
  for (;; j -= 1.0) {
    const double start = pi + 2.0 * pi * std::max(j, 0.0);
    const double bottom = rising_zero(slope, start, start + 0.5 * pi);
    // In trough 0 the bottom is reached because r >= r*; at a graze only but for rounding.
    if (j <= 0.0 && gap(bottom) > 0.0) return 0.5 * pi - bottom / X;
    if (gap(bottom) <= 0.0) return 0.5 * pi - rising_zero(gap, bottom, start + pi) / X;
  }
}

double admissibility_margin(const FrequencyRatio& ratio, double r) {
  const double slow_over_fast = ratio.is_inverse ? 1.0 / r : r;
  return ratio.odd == 1.0 ? 1.0 + r : 1.0 - slow_over_fast / r_star(ratio.odd);
}

void require_admissible(std::string_view who, const FrequencyRatio& ratio, double r,
                        const SlowMass& slow) {
  const double excess = excess_over_r_star(ratio, r);
  if (excess < 0.0) return;
  const double X = ratio.odd, limit = ratio.is_inverse ? 1.0 / r_star(X) : r_star(X);
  const double angle = first_contact_angle(X, ratio.is_inverse ? 1.0 / r : r);
  const double t = angle / slow.omega;
  const double u = slow.start * std::exp(-slow.sigma * t) * std::cos(angle);
  const auto allowed = ratio.is_inverse ? fmt::format("r > 1/r*({:.0f}) = {:.10g}", X, limit)
                                        : fmt::format("0 < r < r*({:.0f}) = {:.10g}", X, limit);
  refuse(who, "r", r, allowed, explain(excess == 0.0, ratio.is_inverse, r / limit, t, u),
         "not-admissible");
}

}  // namespace clackers::exact
