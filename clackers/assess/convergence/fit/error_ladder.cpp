#include "clackers/assess/convergence/fit/error_ladder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"

namespace clackers::assess {
namespace {

void validate(const ErrorPoint& point) {
  require_step("ladder fit", point.step);
  if (point.error < 0.0) refuse("ladder fit", "error", point.error, "0 or more");
  if (!(point.floor >= 0.0)) refuse("ladder fit", "rounding floor", point.floor, "0 or more");
}

LevelView view_level(ErrorLevel level) {
  std::ranges::stable_sort(level, std::greater{}, &ErrorPoint::step);
  LevelView seen;
  seen.error = -1.0;
  if (!level.empty()) seen.step = level.front().step;
  std::size_t finite = 0, rounding = 0, bending = 0;
  for (const auto& point : level) {
    validate(point);
    if (!std::isfinite(point.error)) continue;
    ++finite;
    rounding += point.error <= rounding_slack * point.floor;
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
  seen.usable = finite > 0 && 2 * finite >= level.size();
  seen.at_floor = seen.usable && rounding == finite;
  seen.near_floor = seen.usable && 4 * rounding >= finite;
  seen.may_bend = seen.usable && 4 * bending >= finite;
  if (!seen.usable) seen.error = std::numeric_limits<double>::quiet_NaN();
  return seen;
}

}  // namespace

std::vector<LevelView> view(std::span<const ErrorLevel> ladder) {
  std::vector<LevelView> levels;
  double before = std::numeric_limits<double>::infinity();
  for (const auto& level : ladder) {
    levels.push_back(view_level(level));
    for (const auto& point : level)
      if (!(point.step < before))
        refuse("ladder fit", "a step of level " + std::to_string(levels.size()), point.step,
               "below every step of the level before it", "Give the levels coarsest first.");
    for (const auto& point : level) before = std::min(before, point.step);
  }
  return levels;
}

}  // namespace clackers::assess
