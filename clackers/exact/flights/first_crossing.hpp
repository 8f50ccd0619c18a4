#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "clackers/base/constants.hpp"
#include "clackers/numerics/first_root.hpp"
#include "clackers/numerics/roots.hpp"

namespace clackers::exact {

/// The first time a gap closes, as far as the error of the gap permits to say.
struct Crossing {
  enum class Status {
    none,       ///< the gap stays open
    certain,    ///< it closes at s, and would go beyond by `certain_depth` errors at least
    uncertain,  ///< it comes to `gap` at s, which the error does not tell from 0
    undecided   ///< too many steps
  };
  Status status = Status::none;
  double s = 0.0, gap = 0.0, error = 0.0;
  double near = 0.0;  ///< of an uncertain one, where the gap begins to be small
};

/// A crossing is a smooth function of the state as long as the depth that the gap would reach is
/// large against its error: the term of second order is error / (2 depth) of that of first order.
constexpr double certain_depth = 100.0;
/// A gap that stays above this many errors stays open.
constexpr double certain_gap = 2.0;

/// x after which a gap that begins with value, slope >= 0 is above `level`, without a zero before.
inline std::optional<double> departure(const numerics::LocalBound& gap, double level) {
  const double value = std::max(gap.value, 0.0), slope = std::max(gap.slope, 0.0);
  if (value >= level && value > 0.0) return 0.0;
  // Half of what the first two derivatives give; the other half is for the third.
  const double first = 0.5 * slope, second = 0.25 * std::max(gap.second, 0.0);
  const double x =
      2.0 * (level - value) / (first + std::sqrt(first * first + 4.0 * second * (level - value)));
  const double least = value + x * (slope + x * (0.5 * gap.second - x * gap.third_bound / 6.0));
  if (!(std::isfinite(x) && x < gap.reach && least >= level * (1.0 - 1e-9))) return std::nullopt;
  return x;
}

/// What a gap that has come near zero at s and does not open there does next: a Crossing, or none with
/// s from where it is above `level` again. `error(s)` bounds the error of the gap.
Crossing settle(auto&& gap, auto&& error, double level, double s) {
  using enum Crossing::Status;
  const double start = s;
  auto now = gap.whole(s);
  const double first_value = std::max(now.value, 0.0);
  const auto falls_beyond = [&](double depth) {
    const double x = 2.0 * (std::max(now.value, 0.0) + depth) / -now.slope;
    const double lowered =
        now.value + x * (now.slope + x * (0.5 * std::abs(now.second) + x * now.third_bound / 6.0));
    return now.slope < 0.0 && lowered <= -depth && now.value >= -depth;
  };
  // The bound for the whole search costs nothing, and most impacts are certain with it.
  double beyond = certain_depth / certain_gap * level;
  if (!falls_beyond(beyond)) beyond = certain_depth * error(s);
  const auto root = [&](double from, double to, double at_to) {
    const auto value = [&](double x) { return gap.whole(x).value; };
    return numerics::shrink(value, {from, first_value, to, at_to}, 0.5 * epsilon * to).b;
  };
  // Newton's step from here would change the gap by no more than a share of its error.
  const auto is_least = [&] {
    return now.slope >= 0.0 || now.slope * now.slope <= 0.01 * level * now.second;
  };
  double before = s;
  for (int step = 0; step < 200 && !is_least(); ++step) {
    if (falls_beyond(beyond)) {
      // It falls all the way.
      for (int newton = 0; newton < 20; ++newton) {
        const double change = -now.value / now.slope;
        s = std::max(start, s + change);
        if (std::abs(change) <= epsilon * s || s == start) break;
        now = gap.whole(s);
      }
      return {certain, s, now.value, beyond / certain_depth};
    }
    if (now.value <= -beyond)
      return {certain, root(start, s, now.value), 0.0, beyond / certain_depth};
    before = s;
    // As long as the second derivative is negative for certain, the gap falls faster and faster.
    const auto falling = [&] {
      const double deep = numerics::first_zero(now.value + 2.0 * beyond, now.slope, now.second);
      return std::min(deep, -now.second / now.third_bound);
    };
    s += now.second > 0.0 ? -now.slope / now.second
                          : std::max({-now.slope / now.curvature, falling(), epsilon * s});
    now = gap.whole(s);
  }
  if (!is_least() || !std::isfinite(now.value)) return {undecided};
  if (s > before && now.slope > 0.0) {
    const double width = std::sqrt(0.01 * level / std::max(now.curvature, level));
    const auto falls = [&](double x) { return -gap.whole(x).slope; };
    if (s - before > width)
      s = numerics::shrink(falls, {before, -gap.whole(before).slope, s, -now.slope}, width).b;
    now = gap.whole(s);
  }
  const double here = error(s);
  if (now.value <= -certain_depth * here) return {certain, root(start, s, now.value), 0.0, here};
  if (now.value > certain_gap * here)
    if (const auto x = departure(now, level)) return {none, s + *x, now.value, here};
  return {uncertain, s, now.value, here, start};
}

/// The first closing of `gap` after `from`, where it comes near to zero by `until`. gap(s, level) is the LocalBound of
/// it less a level, gap.whole(s) that of which all is of the gap itself; `level` is certain_gap times a
/// bound on its error up to `until`.
/// Dips below `level` of a quarter of it may remain unnoticed, so nothing above 3/4 of it is
/// passed that is not open for certain.
Crossing first_crossing(auto&& gap, auto&& error, double level, double from, double until,
                        int most_steps) {
  using enum Crossing::Status;
  const auto raised = [&](double s) { return gap(s, level); };
  const auto value = [&](double s) { return gap.whole(s).value - level; };
  while (from < until) {
    const auto now = gap.whole(from);
    double near = from;
    if (!(now.value <= level && now.slope < 0.0)) {
      const double shortest = std::sqrt(2.0 * level / std::max(now.curvature, 1e-300));
      const auto root = numerics::first_root(raised, from, until, shortest, most_steps);
      if (root.status == numerics::FirstRoot::Status::undecided) return {undecided};
      if (root.status == numerics::FirstRoot::Status::none) return {};
      near = root.s;
      // Its last step may have been too long for a low arc.
      if (const double beyond = value(near); beyond < -0.5 * level) {
        const double before = std::max(from, near - shortest), at_before = value(before);
        near = at_before > 0.0
                   ? numerics::shrink(value, {before, at_before, near, beyond}, 0.01 * shortest).a
                   : before;
      }
    }
    const auto found = settle(gap, error, level, near);
    if (found.status == uncertain && found.s > until) {
      // It falls up to there; what it comes to later does not matter.
      const double last = gap.whole(until).value, here = error(until);
      if (last > certain_gap * here) return {};
      return {uncertain, until, last, here, near};
    }
    if (found.status != none) return found;
    from = std::max(found.s, std::nextafter(from, until));
  }
  return {};
}

}  // namespace clackers::exact
