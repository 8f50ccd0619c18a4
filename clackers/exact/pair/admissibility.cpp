#include "clackers/exact/pair/admissibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/wide_motion.hpp"

namespace clackers::exact {
namespace {

using std::numbers::pi;

// The zero of an increasing function between a point where it is negative and one where it is
// not, to the last bit.
template <class Function>
double rising_zero(const Function& f, double below, double above) {
  for (;;) {
    const double middle = below + 0.5 * (above - below);
    if (!(below < middle && middle < above)) return above;
    (f(middle) < 0.0 ? below : above) = middle;
  }
}

// With x = X phi, phi = pi/2 - Omega t the angle before the collision, slow minus fast displacement
// is proportional to X sin(x/X) + r sin x. Its minimum over r decides: r* = -X sin(x/X)/sin(x) at
// the x in (pi, 3 pi/2) where tan x = X tan(x/X). The ratio is stationary there, so the error of
// the double x (1e-15) enters squared.
Wide wide_r_star(double X) {
  if (X == 3.0) return 3;
  const double x = rising_zero(
      [X](double y) { return X * std::sin(y / X) * std::cos(y) - std::sin(y) * std::cos(y / X); },
      pi, 1.5 * pi);
  return -X * sin(Wide(x) / X) / sin(Wide(x));
}

// 1e-25 lies far above the error of r* (1e-29) and far below the distance 1e-16 of a double from an
// r* that is none; r*(3) = 3 and r*(5) = 4 are doubles.
enum class Reach { below, grazes, beyond };
Reach reach(const Wide& r, double X) {
  if (X == 1.0) return Reach::below;
  const Wide excess = r / wide_r_star(X) - 1;
  if (abs(excess) < 1e-25) return Reach::grazes;
  return excess < 0 ? Reach::below : Reach::beyond;
}

// What would happen and what to change; `factor` is r over its limit.
std::string explain(Reach how, bool exchanged, double factor, double t, double u) {
  const auto value = how == Reach::grazes
                         ? std::string("exactly on it: the masses would graze")
                         : fmt::format("{:.6g} times it: the masses would {}", factor,
                                       t == 0.0 ? "touch or overlap already" : "touch");
  const auto end = how == Reach::grazes ? "so that no computation can tell contact from none"
                                        : "and the closed form would not hold";
  return fmt::format(
      "The value is {} at t = {:.6g} s, where u1 = u2 = {:.6g} m, away from equilibrium, {}. Take "
      "r "
      "{} the limit, or X = 1, which takes every r.",
      value, t, u, end, exchanged ? "above" : "below");
}

}  // namespace

double r_star(double X) {
  return X == 1.0 ? std::numeric_limits<double>::infinity() : to_double(wide_r_star(X));
}

double first_contact_angle(double X, double r) {
  if (X + r * quarter_sine(X) <= 0.0) return 0.0;
  const auto opening = [X, r](double x) { return X * std::sin(x / X) + r * std::sin(x); };
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
    if (j <= 0.0 && opening(bottom) > 0.0) return 0.5 * pi - bottom / X;
    if (opening(bottom) <= 0.0) return 0.5 * pi - rising_zero(opening, bottom, start + pi) / X;
  }
}

double admissibility_margin(const FrequencyRatio& ratio, double r) {
  const double slow_over_fast = ratio.exchanged ? 1.0 / r : r;
  return ratio.odd == 1.0 ? 1.0 + r : 1.0 - slow_over_fast / r_star(ratio.odd);
}

void require_admissible(std::string_view who, const WideMotion& motion, const FrequencyRatio& ratio,
                        double r) {
  const double X = ratio.odd;
  const Wide slow_over_fast = ratio.exchanged ? 1 / Wide(r) : Wide(r);
  const auto how = reach(slow_over_fast, X);
  if (how == Reach::below) return;

  const Wide limit = ratio.exchanged ? 1 / wide_r_star(X) : wide_r_star(X);
  const double angle = first_contact_angle(X, to_double(slow_over_fast));
  const double t = angle / to_double(motion.omega);
  const double slow_start = to_double(motion.masses[ratio.exchanged ? 1 : 0].start);
  const double u = slow_start * std::exp(-to_double(motion.sigma) * t) * std::cos(angle);
  const auto allowed = ratio.exchanged
                           ? fmt::format("r > 1/r*({:.0f}) = {:.10g}", X, to_double(limit))
                           : fmt::format("0 < r < r*({:.0f}) = {:.10g}", X, to_double(limit));
  refuse(who, "r", r, allowed, explain(how, ratio.exchanged, to_double(r / limit), t, u),
         "not-admissible");
}

}  // namespace clackers::exact
