#include <algorithm>
#include <cmath>

#include "clackers/base/codes.hpp"
#include "clackers/judge/convergence/fit/rules.hpp"

namespace clackers::judge {
namespace {

// The claimed line, as far towards the rounding floor as it goes, but to level `least` at least.
RuleResult claimed_to(const Range& range, const FitContext& context, int least) {
  const double claimed = context.claimed_order;
  if (!(claimed > 0.0)) return {};
  const Straightness asked{
      .rates = context.order_tolerance * claimed, .around_slope = false, .centre = claimed};
  for (int last = range.finest; last >= std::max(least, range.first); --last)
    if (const auto found = longest_straight(range.levels, range.first, last, asked);
        found && !is_underdetermined(range, *found))
      return shows(with_line(range, *found), Behaviour::proper);
  return {};
}

}  // namespace

RuleResult claimed_line(const Range& range, const FitContext& context) {
  auto fit = claimed_to(range, context, range.clear);
  // A bend by a floor that begins to show leaves the order of the line more certain than a bend by a
  // term of a lower order.
  if (fit && fit->spread > context.order_tolerance * context.claimed_order)
    if (auto above = line_with_floor(range, context); above && above->spread < fit->spread)
      return above;
  return fit;
}

// Where nothing else explains them, up to two levels in front of the floor may be bent by it: that
// many lie between the two slacks when an error of order one meets a rounding that grows.
RuleResult bent_by_rounding(const Range& range, const FitContext& context) {
  int least = range.clear;
  while (least > range.clear - 2 && least > range.first && range.level(least).may_bend) --least;
  if (range.above >= range.finest || least == range.clear) return {};
  return claimed_to(range, context, least);
}

RuleResult other_line(const Range& range, const FitContext& context) {
  if (!range.line) return {};
  const double slope = range.line->line.slope, claimed = context.claimed_order;
  // Errors of files that have another limit fall a little where impacts come nearer to theirs.
  const double flat = context.wrong_limit ? highest_flat_slope : straight_rates;
  if (std::abs(slope) <= flat) return stagnates(range, context, *range.line);
  if (is_underdetermined(range, *range.line)) return undecided(range, "one-sample-a-level");
  if (slope > 0.0 && may_still_reach(claimed, *range.line)) {
    // Rates may also stray because the points scatter, still within what a line allows.
    for (const auto rule : {bent_by_rounding, line_with_floor, zigzag})
      if (auto fit = rule(range, context)) return fit;
    return anything_else(range, context);
  }
  const auto fit = with_line(range, *range.line);
  if (slope < 0.0) return diverges(fit);
  return shows(fit, claimed > 0.0 && slope < claimed ? Behaviour::reduced : Behaviour::proper);
}

RuleResult rising_rates(const Range& range, const FitContext& context) {
  const auto tail = range.last(shortest_window);
  if (!tail || !rates_rise(context.claimed_order, *tail)) return {};
  return undecided(range, "no-fixed-order");
}

// Growth that is no line. Errors that rise to a plateau settle; these do not.
RuleResult growth(const Range& range, const FitContext&) {
  const auto tail = range.last(shortest_window);
  if (!tail) return {};
  const bool grows =
      std::ranges::all_of(tail->rates, [](double rate) { return rate < -straight_rates; });
  if (!grows || tail->rates.back() > settling_share * tail->rates.front()) return {};
  return diverges(range.blank);
}

}  // namespace clackers::judge
