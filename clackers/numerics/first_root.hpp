#pragma once

#include <algorithm>
#include <cmath>

#include "clackers/numerics/roots.hpp"

namespace clackers::numerics {

/// A function and what is known of it ahead: |f''| <= curvature as long as one goes on by no more
/// than `reach` > 0.
struct LocalBound {
  double value = 0.0, slope = 0.0;
  double curvature = 0.0;
  double reach = 0.0;
};

struct FirstRoot {
  enum class Status { found, none, undecided };
  Status status = Status::none;
  double s = 0.0;  ///< of the root, where one was found
};

/// The first s in (from, until] where f turns from positive to negative; f(from) >= 0 give or take
/// a rounding. No sampling: from a known value and slope the next zero is not before that of the
/// parabola value + slope x - curvature x^2 / 2, so s moves to that zero, again and again; near a
/// crossing these are Newton's steps from the safe side. Steps are never shorter than `shortest`,
/// so a dip below 0 of less than curvature shortest^2 / 8 may remain unnoticed. `f(s)` returns a
/// LocalBound. Undecided after `most_steps` steps, or where f is not finite.
template <class Function>
FirstRoot first_root(Function&& f, double from, double until, double shortest, int most_steps) {
  using enum FirstRoot::Status;
  double s = from;
  LocalBound now = f(s);
  now.value = std::max(now.value, 0.0);
  for (int step = 0; step < most_steps; ++step) {
    if (!std::isfinite(now.value) || !std::isfinite(now.slope)) return {undecided};
    if (s >= until) return {none};
    double safe = now.reach;
    if (now.curvature > 0.0) {
      const double root = std::sqrt(now.slope * now.slope + 2.0 * now.curvature * now.value);
      // Both forms of the parabola's zero; neither subtracts.
      safe = std::min(safe, now.slope > 0.0 ? (now.slope + root) / now.curvature
                            : root > 0.0    ? 2.0 * now.value / (root - now.slope)
                                            : 0.0);
    } else if (now.slope < 0.0) {
      safe = std::min(safe, now.value / -now.slope);
    }
    const double next = s + std::max(safe, shortest);
    const LocalBound ahead = f(next);
    if (ahead.value < 0.0) {
      const auto value = [&](double x) { return f(x).value; };
      constexpr double epsilon = 0x1p-52;
      const double root =
          shrink(value, {s, now.value, next, ahead.value}, epsilon * std::max(next, shortest)).b;
      if (root > until) return {none};
      return {found, root};
    }
    s = next;
    now = ahead;
  }
  return {undecided};
}

}  // namespace clackers::numerics
