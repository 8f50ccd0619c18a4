#include "clackers/assess/convergence/ladder_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "clackers/assess/convergence/fit/irregular.hpp"
#include "clackers/assess/convergence/fit/window.hpp"
#include "clackers/base/codes.hpp"

namespace clackers::assess {
namespace {

/// Where the levels of a ladder lie, from the finest one down.
struct Range {
  std::vector<LevelView> levels;
  double smallest_step = std::numeric_limits<double>::infinity();
  int finest = -1;             ///< the last level
  int first = 0;               ///< start of the usable levels that lead to it without a gap
  int tracked = 0;             ///< the first of them with errors smaller than the motion itself
  int above = -1, clear = -1;  ///< the last one above the rounding floor, and the last well above
  std::optional<Window> line;  ///< the longest straight one that ends at `clear`
  LadderFit blank;             ///< steps, errors and the rounding floor alone

  const LevelView& level(int i) const { return levels[std::size_t(i)]; }
  std::optional<Window> last(int count) const { return window(levels, clear - count + 1, clear); }
};

Range range_of(std::span<const ErrorLevel> ladder, const FitContext& context) {
  Range range;
  range.levels = view(ladder);
  range.finest = int(range.levels.size()) - 1;
  for (const auto& level : ladder)
    for (const auto& point : level) range.smallest_step = std::min(range.smallest_step, point.step);
  for (const auto& level : range.levels) {
    range.blank.steps.push_back(level.step);
    range.blank.errors.push_back(level.error);
  }
  if (range.finest < 0 || !range.level(range.finest).usable) return range;
  range.first = range.finest;
  while (range.first > 0 && range.level(range.first - 1).usable) --range.first;
  range.tracked = range.first;
  while (range.tracked < range.finest && range.level(range.tracked).error >= context.saturation)
    ++range.tracked;
  range.above = range.finest;
  while (range.above >= range.first && range.level(range.above).at_floor) --range.above;
  for (int i = range.above + 1; i <= range.finest; ++i)
    range.blank.floor = std::max(range.blank.floor, range.level(i).error);
  range.clear = range.above;
  while (range.clear >= range.first && range.level(range.clear).near_floor) --range.clear;
  if (range.above < range.first) range.clear = -1;
  range.line = longest_straight(range.levels, range.first, range.clear, {});
  return range;
}

LadderFit shows(LadderFit fit, Behaviour behaviour, std::string_view reason = {}) {
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

LadderFit with_line(LadderFit fit, const Window& found) {
  fit.has_line = true;
  fit.order = found.line.slope;
  fit.spread = std::max(found.line.slope_spread, drift(found));
  fit.scatter = found.scatter;
  fit.constant = std::exp(found.line.intercept);
  fit.first_level = found.first;
  fit.last_level = found.last;
  return fit;
}

LadderFit stagnates(const Range& range, const FitContext& context, const Window& flat) {
  const auto& errors = range.level(flat.last).y;
  auto fit = range.blank;
  const double floor =
      std::exp(std::accumulate(errors.begin(), errors.end(), 0.0) / double(errors.size()));
  const bool compliant = context.contact_time > 0.0;
  if (!compliant && floor >= context.saturation) return undecided(range, "no-convergence-yet");
  fit.floor = floor;
  fit.scatter = flat.scatter;
  fit.first_level = flat.first;
  fit.last_level = flat.last;
  return shows(std::move(fit), Behaviour::stagnating,
               compliant                  ? Code("contact-stiffness").name()
               : context.states_tolerance ? Code("tolerance-floor").name()
                                          : Code("unexplained-floor").name());
}

LadderFit envelope_decides(const Range& range, const FitContext& context) {
  const auto upper = envelope(range.levels, range.tracked, range.clear);
  if (!upper) return undecided(range, "too-few-levels");
  const double slope = upper->line.slope, spread = upper->line.slope_spread;
  // Rough and flat at the end: all raw points of the last levels together show the trend best.
  const auto tail = range.last(shortest_window);
  if (tail && tail->line.slope + tail->line.slope_spread < highest_flat_slope &&
      tail->line.slope - tail->line.slope_spread > lowest_flat_slope)
    return stagnates(range, context, *tail);
  if (slope < -straight_rates && slope < -spread) return diverges(range.blank);
  if (!(slope > straight_rates && slope > spread)) return undecided(range, "no-convergence-yet");
  auto fit = range.blank;
  fit.has_line = fit.on_envelope = true;
  fit.order = slope;
  fit.spread = spread;
  fit.scatter = upper->scatter;
  fit.constant = std::exp(upper->line.intercept);
  fit.first_level = upper->first;
  fit.last_level = upper->last;
  return shows(std::move(fit), Behaviour::irregular);
}

bool grows(const Window& window) {
  return std::ranges::all_of(window.rates, [](double rate) { return rate < -straight_rates; });
}

Straightness as_claimed(const FitContext& context) {
  return {
      .rates = 0.1 * context.claimed_order, .around_slope = false, .centre = context.claimed_order};
}

// The claimed line, as far towards the rounding floor as it goes, but to level `least` at least.
std::optional<LadderFit> claimed_to(const Range& range, const FitContext& context, int least) {
  if (!(context.claimed_order > 0.0)) return {};
  for (int last = range.finest; last >= std::max(least, range.first); --last)
    if (const auto found = longest_straight(range.levels, range.first, last, as_claimed(context)))
      return shows(with_line(range.blank, *found), Behaviour::proper);
  return {};
}

std::optional<LadderFit> nothing_to_fit(const Range& range, const FitContext& context) {
  if (range.levels.empty()) return undecided(range, "too-few-levels");
  if (context.contact_time > 0.0 && range.smallest_step * steps_per_contact > context.contact_time)
    return undecided(range, "contact-not-resolved");
  return {};
}

std::optional<LadderFit> finest_failed(const Range& range, const FitContext&) {
  if (range.level(range.finest).usable) return {};
  int last = range.finest;
  while (last >= 0 && !range.level(last).usable) --last;
  const auto tail = last >= 2 ? window(range.levels, last - 2, last) : std::nullopt;
  return tail && grows(*tail) ? diverges(range.blank) : undecided(range, "run-failed");
}

std::optional<LadderFit> at_rounding_floor(const Range& range, const FitContext&) {
  if (range.clear >= 0) return {};
  return range.first > 0 ? undecided(range, "run-failed") : shows(range.blank, Behaviour::exact);
}

std::optional<LadderFit> claimed_line(const Range& range, const FitContext& context) {
  return claimed_to(range, context, range.clear);
}

std::optional<LadderFit> floor_too_near(const Range& range, const FitContext&) {
  if (range.clear - range.first + 1 >= shortest_window) return {};
  return undecided(range, "too-few-levels");
}

std::optional<LadderFit> zigzag(const Range& range, const FitContext& context) {
  if (range.clear - range.tracked + 1 < shortest_window ||
      !zigzags(range.levels, range.tracked, range.clear))
    return {};
  return envelope_decides(range, context);
}

// Where nothing else explains them, up to two levels in front of the floor may be bent by it: that
// many lie between the two slacks when an error of order one meets a rounding that grows.
std::optional<LadderFit> bent_by_rounding(const Range& range, const FitContext& context) {
  int least = range.clear;
  while (least > range.clear - 2 && least > range.first && range.level(least).may_bend) --least;
  if (range.above >= range.finest || least == range.clear) return {};
  return claimed_to(range, context, least);
}

std::optional<LadderFit> anything_else(const Range& range, const FitContext& context) {
  const auto tail = range.last(2);
  const bool claimed =
      tail && context.claimed_order > 0.0 && is_straight(*tail, as_claimed(context));
  return undecided(range, claimed ? Code("too-few-levels") : Code("no-convergence-yet"));
}

std::optional<LadderFit> other_line(const Range& range, const FitContext& context) {
  if (!range.line) return {};
  const double slope = range.line->line.slope, claimed = context.claimed_order;
  if (std::abs(slope) <= straight_rates) return stagnates(range, context, *range.line);
  if (slope > 0.0 && may_still_reach(claimed, *range.line)) {
    // Rates may also stray because the points scatter, still within what a line allows.
    for (const auto rule : {zigzag, bent_by_rounding})
      if (auto fit = rule(range, context)) return fit;
    return anything_else(range, context);
  }
  const auto fit = with_line(range.blank, *range.line);
  if (slope < 0.0) return diverges(fit);
  return shows(fit, claimed > 0.0 && slope < claimed ? Behaviour::reduced : Behaviour::proper);
}

std::optional<LadderFit> plateau(const Range& range, const FitContext& context) {
  const auto tail = range.last(shortest_plateau);
  const Straightness flat{.rates = straight_rates, .around_slope = false, .centre = 0.0};
  if (!tail || !is_straight(*tail, flat)) return {};
  return stagnates(range, context, *tail);
}

// Growth that is no line. Errors that rise to a plateau settle; these do not.
std::optional<LadderFit> growth(const Range& range, const FitContext&) {
  const auto tail = range.last(shortest_window);
  if (!tail || !grows(*tail) || tail->rates.back() > settling_share * tail->rates.front())
    return {};
  return diverges(range.blank);
}

std::optional<LadderFit> outliers(const Range& range, const FitContext& context) {
  const Straightness asked{.outliers_of = outlier_share};
  if (!longest_straight(range.levels, range.first, range.clear, asked)) return {};
  return envelope_decides(range, context);
}

std::optional<LadderFit> swinging(const Range& range, const FitContext& context) {
  if (range.clear - range.tracked + 1 < shortest_window ||
      !swings(range.levels, range.tracked, range.clear))
    return {};
  return envelope_decides(range, context);
}

std::optional<LadderFit> rising_rates(const Range& range, const FitContext& context) {
  const auto tail = range.last(shortest_window);
  if (!tail || !rates_rise(context.claimed_order, *tail)) return {};
  return undecided(range, "no-fixed-order");
}

using Rule = std::optional<LadderFit> (*)(const Range&, const FitContext&);

// As numbered in the header.
constexpr Rule rules[] = {nothing_to_fit, finest_failed, at_rounding_floor, claimed_line,
                          floor_too_near, other_line,    plateau,           zigzag,
                          growth,         outliers,      swinging,          bent_by_rounding,
                          rising_rates,   anything_else};

}  // namespace

LadderFit fit_ladder(std::span<const ErrorLevel> ladder, const FitContext& context) {
  const auto range = range_of(ladder, context);
  for (const auto rule : rules)
    if (auto fit = rule(range, context)) return *std::move(fit);
  return range.blank;
}

}  // namespace clackers::assess
