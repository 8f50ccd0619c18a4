#pragma once

#include <limits>
#include <optional>

#include "clackers/numerics/roots.hpp"

namespace clackers::methods {

/// The gap of a contact at one instant of a step.
struct GapSample {
  double s = 0.0;     ///< after the start of the piece of the step that is looked at [s]
  double g = 0.0;     ///< gap [m]
  double rate = 0.0;  ///< dg/ds [m/s]
};

/// Control points of the cubic that meets gap and gap rate at both ends. The cubic lies between
/// the smallest and the largest of them; where all are >= 0 it does not cross 0.
struct GapCubic {
  double first, second, third, last;

  GapCubic(const GapSample& a, const GapSample& b)
      : first(a.g),
        second(a.g + (b.s - a.s) * (1.0 / 3.0) * a.rate),
        third(b.g - (b.s - a.s) * (1.0 / 3.0) * b.rate),
        last(b.g) {}

  /// False for a cubic that is no number.
  bool stays_above(double level) const {
    return first >= level && second >= level && third >= level && last >= level;
  }
  bool falls() const { return first >= second && second >= third && third >= last; }
};

/// The first instant in [a.s, b.s] after which the gap, seen as `at(s)` gives it, is violated; or
/// nothing if it stays open there. a.g must not be below -rounding.
///
/// A piece of the step is discarded when its cubic stays above -rounding, searched for its root
/// when it ends violated and its cubic falls throughout, and halved otherwise: so two crossings
/// inside one step are found as long as the cubic, exact to the fourth order of the piece, sees
/// them. The root is located on the step map itself until the piece left is a unit in the last
/// place of the step; its open end is returned. A touch less deep than `rounding` is none.
/// `budget` bounds the evaluations spent on halving; when it is used up, a piece that ends
/// violated is taken as one crossing and a piece that ends open as none.
std::optional<double> first_crossing(const auto& at, const GapSample& a, const GapSample& b,
                                     double rounding, int& budget) {
  const GapCubic cubic(a, b);
  if (cubic.stays_above(-rounding)) return std::nullopt;
  const double middle = a.s + 0.5 * (b.s - a.s);
  const bool is_spent = budget <= 0 || !(middle > a.s && middle < b.s);
  if (b.g < -rounding && (is_spent || cubic.falls())) {
    if (a.g <= 0.0) return a.s;
    const double unit = std::numeric_limits<double>::epsilon() * b.s;
    return numerics::shrink([&](double s) { return at(s).g; }, {a.s, a.g, b.s, b.g}, unit).a;
  }
  if (is_spent) return std::nullopt;
  --budget;
  const GapSample m = at(middle);
  if (const auto s = first_crossing(at, a, m, rounding, budget)) return s;
  return first_crossing(at, m, b, rounding, budget);
}

}  // namespace clackers::methods
