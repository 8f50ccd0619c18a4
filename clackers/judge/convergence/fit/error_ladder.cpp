#include "clackers/judge/convergence/fit/error_ladder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"

namespace clackers::judge {
namespace {

void validate(const ErrorPoint& point) {
  require_step("ladder fit", point.step);
  if (point.error < 0.0) refuse("ladder fit", "error", point.error, "0 or more");
  if (!(point.floor >= 0.0)) refuse("ladder fit", "rounding floor", point.floor, "0 or more");
}

bool at_floor(const ErrorPoint& point) { return point.error <= rounding_slack * point.floor; }

bool far_above_floor(const ErrorPoint& point) {
  return std::isfinite(point.error) && point.error > bending_slack * point.floor;
}

LevelView view_level(const ErrorLevel& level, double coincident_above, bool was_coincident) {
  LevelView seen;
  seen.error = -1.0;
  if (!level.empty()) seen.step = level.front().step;
  const bool others_err = was_coincident && std::ranges::any_of(level, far_above_floor);
  std::size_t finite = 0, rounding = 0, bending = 0;
  for (const auto& point : level) {
    if (!std::isfinite(point.error)) continue;
    ++finite;
    if (at_floor(point) && (others_err || point.step > coincident_above)) {
      ++seen.coincident;
      seen.error = std::max(seen.error, point.error);
      continue;
    }
    rounding += at_floor(point);
    bending += point.error <= bending_slack * point.floor;
    if (point.error > seen.error) {
      seen.error = point.error;
      seen.step = point.step;
    }
    // A zero has no place on logarithmic axes.
    if (point.error == 0.0) continue;
    seen.x.push_back(std::log(point.step));
    seen.y.push_back(std::log(point.error));
  }
  const auto others = finite - std::size_t(seen.coincident);
  seen.usable = finite > 0 && 2 * finite >= level.size();
  seen.at_floor = seen.usable && rounding == others && seen.coincident == 0;
  seen.near_floor = seen.usable && others > 0 && 4 * rounding >= others;
  seen.may_bend = seen.usable && others > 0 && 4 * bending >= others;
  if (!seen.usable) seen.error = std::numeric_limits<double>::quiet_NaN();
  return seen;
}

// The smallest step with an error far above its floor; infinite without one.
double smallest_that_errs(std::span<const ErrorLevel> ladder) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& level : ladder)
    for (const auto& point : level)
      if (far_above_floor(point)) smallest = std::min(smallest, point.step);
  return smallest;
}

}  // namespace

std::vector<LevelView> view(std::span<const ErrorLevel> ladder) {
  for (const auto& level : ladder)
    for (const auto& point : level) validate(point);
  const double coincident_above = smallest_that_errs(ladder);
  std::vector<LevelView> levels;
  double before = std::numeric_limits<double>::infinity();
  bool was_coincident = false;
  for (auto level : ladder) {
    std::ranges::stable_sort(level, std::greater{}, &ErrorPoint::step);
    levels.push_back(view_level(level, coincident_above, was_coincident));
    was_coincident = was_coincident || levels.back().coincident > 0;
    for (const auto& point : level)
      if (!(point.step < before))
        refuse("ladder fit", "a step of level " + std::to_string(levels.size()), point.step,
               "below every step of the level before it", "Give the levels coarsest first.");
    for (const auto& point : level) before = std::min(before, point.step);
  }
  return levels;
}

RawPoints raw_points(std::span<const LevelView> levels, int first, int last) {
  RawPoints all;
  for (int i = first; i <= last; ++i) {
    const auto& level = levels[std::size_t(i)];
    all.x.insert(all.x.end(), level.x.begin(), level.x.end());
    all.y.insert(all.y.end(), level.y.begin(), level.y.end());
  }
  return all;
}

}  // namespace clackers::judge
