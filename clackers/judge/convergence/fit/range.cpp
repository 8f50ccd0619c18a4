#include "clackers/judge/convergence/fit/range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/codes.hpp"
#include "clackers/judge/convergence/fit/two_terms.hpp"

namespace clackers::judge {
namespace {

// An error this many times as large as the motion is one of an unstable run.
constexpr double unstable_error = 1e3;

void note_unstable_steps(Range& range, std::span<const ErrorLevel> ladder) {
  double failed = 0.0, smallest_failed = std::numeric_limits<double>::infinity();
  for (const auto& level : ladder)
    for (const auto& point : level)
      if (!(point.error < unstable_error)) smallest_failed = std::min(smallest_failed, point.step);
  for (const auto& level : ladder)
    for (const auto& point : level)
      if (point.error < unstable_error && point.step < smallest_failed)
        failed = std::max(failed, point.step);
  if (std::isfinite(smallest_failed)) range.blank.stable_step = failed;
}

}  // namespace

Range range_of(std::span<const ErrorLevel> ladder, const FitContext& context) {
  Range range;
  range.levels = view(ladder);
  range.finest = int(range.levels.size()) - 1;
  range.smallest_step = std::numeric_limits<double>::infinity();
  int runs = 0, coincident = 0;
  for (const auto& level : ladder)
    for (const auto& point : level) {
      ++runs;
      range.smallest_step = std::min(range.smallest_step, point.step);
    }
  for (const auto& level : range.levels) {
    range.blank.steps.push_back(level.step);
    range.blank.errors.push_back(level.error);
    coincident += level.coincident;
  }
  range.blank.coincident_share = double(coincident) / std::max(1, runs);
  if (range.finest < 0 || !range.level(range.finest).usable) return range;
  note_unstable_steps(range, ladder);
  range.first = range.finest;
  while (range.first > 0 && range.level(range.first - 1).usable) --range.first;
  range.tracked = range.first;
  while (range.tracked < range.finest && range.level(range.tracked).error >= context.saturation)
    ++range.tracked;
  range.above = range.finest;
  while (range.above >= range.first && range.level(range.above).at_floor) --range.above;
  for (int i = range.above + 1; i <= range.finest; ++i) {
    range.blank.floor = std::max(range.blank.floor, range.level(i).error);
    if (range.blank.floor_step == 0.0) range.blank.floor_step = ladder[std::size_t(i)].front().step;
  }
  range.clear = range.above;
  while (range.clear >= range.first && range.level(range.clear).near_floor) --range.clear;
  range.line = longest_straight(range.levels, range.first, range.clear, {});
  return range;
}

LadderFit shows(LadderFit fit, Behaviour behaviour, std::string_view reason) {
  fit.behaviour = behaviour;
  fit.reason = reason;
  return fit;
}

LadderFit undecided(const Range& range, Code reason) {
  return shows(range.blank, Behaviour::undecided, reason.name());
}

LadderFit diverges(const LadderFit& fit) {
  return shows(fit, Behaviour::divergent, Code("error-growth").name());
}

LadderFit with_line(const Range& range, const Window& found) {
  auto fit = range.blank;
  constexpr std::size_t enough_to_bend = 5;
  // What bends may be rounding.
  int last = found.last;
  while (last - found.first > 1 && range.level(last).may_bend) --last;
  auto points = raw_points(range.levels, found.first, last);
  if (points.x.size() < enough_to_bend) points = raw_points(range.levels, found.first, found.last);
  const auto interval = order_interval(points.x, points.y);
  fit.has_line = true;
  fit.order = found.line.slope;
  fit.spread = std::max({found.line.slope_spread, interval.half_width(), drift(found)});
  if (last < found.last)
    if (const auto above = window(range.levels, found.first, last))
      fit.spread += std::abs(above->line.slope - fit.order);
  fit.spread = std::max(fit.spread, shortfall_of_floor(range, found.first, found.last, fit.order));
  fit.scatter = found.scatter;
  fit.constant = std::exp(found.line.intercept);
  fit.first_level = found.first;
  fit.last_level = found.last;
  fit.largest_step = found.largest_step;
  fit.smallest_step = found.smallest_step;
  // A line that goes on below the floor shows that there is none.
  if (fit.smallest_step < fit.floor_step) fit.floor = fit.floor_step = 0.0;
  return fit;
}

double shortfall_of_floor(const Range& range, int first, int last, double order) {
  double most = order_above_floor(range.levels, first, last);
  if (order < 1.0) {
    const auto coarse = window(range.levels, range.tracked, (range.tracked + last + 1) / 2);
    if (coarse && coarse->line.slope > order) most = std::max(most, 1.0);
  }
  return std::max(0.0, most - order);
}

bool is_underdetermined(const Range& range, const Window& found) {
  if (!one_sample_a_level(range) || found.first <= range.tracked) return false;
  const auto before = window(range.levels, range.tracked, found.first);
  return before && std::ranges::any_of(before->rates, [](double rate) { return rate < 0.0; });
}

Behaviour behaviour_of_order(double order, const FitContext& context) {
  return order >= 0.9 * context.claimed_order ? Behaviour::proper : Behaviour::reduced;
}

Code floor_reason(const FitContext& context, bool rough) {
  if (context.contact_time > 0.0) return "contact-stiffness";
  if (context.states_tolerance) return "tolerance-floor";
  if (context.wrong_limit) return "wrong-limit";
  return rough ? Code("noise-floor") : Code("unexplained-floor");
}

double octaves_of(const RawPoints& points) {
  if (points.x.size() < 2) return 0.0;
  const double apart = (points.x.front() - points.x.back()) / std::log(2.0);
  return apart * double(points.x.size()) / double(points.x.size() - 1);
}

bool one_sample_a_level(const Range& range) {
  int several = 0;
  for (int i = range.first; i <= range.clear; ++i) several += range.level(i).x.size() > 1;
  return 2 * several < range.clear_levels();
}

std::optional<Window> line_up_to(const Range& range, const FitContext& context, int last) {
  constexpr int shortest = 3;
  constexpr std::size_t fewest_points = 4;
  // Spacings of whole numbers of steps miss the third octave by a little.
  constexpr double whole_numbers = 0.05;
  for (int from = range.first; from + shortest - 1 <= last; ++from) {
    const auto points = raw_points(range.levels, from, last);
    if (points.x.size() < fewest_points || octaves_of(points) < shortest_line - whole_numbers)
      return {};
    const auto found = window(range.levels, from, last);
    if (!found || found->line.slope <= straight_rates) continue;
    Straightness asked;
    if (context.claimed_order > 0.0 &&
        std::abs(found->line.slope - context.claimed_order) <= 0.1 * context.claimed_order)
      asked.rates = std::max(asked.rates, 0.1 * context.claimed_order);
    if (is_straight(*found, asked)) return found;
  }
  return {};
}

}  // namespace clackers::judge
