#include <algorithm>
#include <cmath>

#include "clackers/base/codes.hpp"
#include "clackers/judge/convergence/fit/irregular.hpp"
#include "clackers/judge/convergence/fit/rules.hpp"

namespace clackers::judge {
namespace {

// Whether rough levels do not fall: no order of 3/4 or more is within the uncertainty of their slope.
bool is_flat(const Window& tail) {
  const double slope = tail.line.slope, spread = tail.line.slope_spread;
  return slope < highest_flat_slope && slope + spread < lowest_real_order &&
         slope - spread > -lowest_real_order;
}

// The claimed line of the finest clear levels, where the order is so high that only three lie between
// rough steps and rounding.
std::optional<Window> fine_line(const Range& range, const FitContext& context) {
  const double claimed = context.claimed_order;
  const auto line = claimed > 0.0 ? line_up_to(range, context, range.clear) : std::nullopt;
  if (!line || std::abs(line->line.slope - claimed) > context.order_tolerance * claimed) return {};
  return line;
}

LadderFit envelope_decides(const Range& range, const FitContext& context) {
  if (one_sample_a_level(range)) return undecided(range, "one-sample-a-level");
  if (const auto line = fine_line(range, context))
    return shows(with_line(range, *line), Behaviour::proper);
  const auto upper = envelope(range.levels, range.tracked, range.clear);
  if (!upper)
    return undecided(range,
                     range.tracked > range.first ? Code("larger-than-motion") : "too-few-levels");
  const double slope = upper->order;
  const double spread =
      std::max(upper->spread, shortfall_of_floor(range, upper->first, upper->last, slope));
  // Rough and flat at the end: all raw points of the last levels together show the trend best.
  const auto tail = range.last(shortest_window);
  if (tail && is_flat(*tail)) return stagnates(range, context, *tail);
  if (slope < -straight_rates && slope < -upper->spread) return diverges(range.blank);
  if (!(slope > straight_rates && slope > spread)) return undecided(range, "more-samples");
  auto fit = range.blank;
  fit.has_line = fit.on_envelope = true;
  fit.order = slope;
  fit.spread = spread;
  fit.scatter = upper->scatter;
  fit.constant = std::exp(upper->line.intercept);
  fit.first_level = upper->first;
  fit.last_level = upper->last;
  fit.largest_step = std::exp(range.level(upper->first).x.front());
  fit.smallest_step = std::exp(range.level(upper->last).x.back());
  return shows(std::move(fit), Behaviour::irregular);
}

}  // namespace

RuleResult zigzag(const Range& range, const FitContext& context) {
  if (range.tracked_levels() < shortest_window ||
      !zigzags(range.levels, range.tracked, range.clear))
    return {};
  return envelope_decides(range, context);
}

RuleResult outliers(const Range& range, const FitContext& context) {
  const Straightness asked{.outliers_of = outlier_share};
  if (!longest_straight(range.levels, range.first, range.clear, asked)) return {};
  return envelope_decides(range, context);
}

RuleResult swinging(const Range& range, const FitContext& context) {
  if (range.tracked_levels() < shortest_window || !swings(range.levels, range.tracked, range.clear))
    return {};
  return envelope_decides(range, context);
}

}  // namespace clackers::judge
