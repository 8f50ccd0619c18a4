#include <algorithm>
#include <cmath>

#include "clackers/base/codes.hpp"
#include "clackers/judge/convergence/fit/rules.hpp"
#include "clackers/judge/convergence/fit/two_terms.hpp"

namespace clackers::judge {
namespace {

// A law of two terms that cancel is believed where it follows the errors within this factor of those
// around them: a smooth ladder, since scatter hides a zero.
constexpr double cancelling_scatter = 1.15;

// Octaves below the zero until a floor shows, and until the order of the lower term does.
constexpr double octaves_to_floor = 1.0, octaves_to_order = 2.0;

std::optional<TwoTerms> best_law(const Range& range) {
  constexpr Terms candidates[] = {
      {.p = 0.0, .q = 0.0, .cancels = true}, {.p = 2.0, .q = 1.0, .cancels = true},
      {.p = 3.0, .q = 1.0, .cancels = true}, {.p = 3.0, .q = 2.0, .cancels = true},
      {.p = 4.0, .q = 2.0, .cancels = true}, {.p = 4.0, .q = 3.0, .cancels = true},
      {.p = 5.0, .q = 4.0, .cancels = true}, {.p = 6.0, .q = 4.0, .cancels = true}};
  std::optional<TwoTerms> best;
  for (const auto& terms : candidates) {
    const auto law = fit_two_terms(range.levels, range.tracked, range.clear, terms);
    if (law && law->scatter <= cancelling_scatter && (!best || law->scatter < best->scatter))
      best = law;
  }
  return best;
}

LadderFit dips_to_floor(const Range& range, const FitContext& context, const TwoTerms& law) {
  auto fit = range.blank;
  fit.cancel_step = law.crossing;
  fit.floor = -law.b;
  fit.floor_step = law.crossing;
  fit.first_level = range.tracked;
  fit.last_level = range.clear;
  fit.largest_step = law.largest;
  fit.smallest_step = law.smallest;
  if (law.octaves_of_p() >= shortest_line) {
    fit.has_line = true;
    fit.order = law.p;
    fit.spread = law.p_spread;
    fit.constant = law.a;
    fit.smallest_step = law.crossing;
  }
  return shows(fit, Behaviour::stagnating, floor_reason(context, false).name());
}

LadderFit lower_term(const Range& range, const FitContext& context, const TwoTerms& law) {
  auto fit = range.blank;
  fit.has_line = true;
  fit.cancel_step = law.crossing;
  fit.order = law.q;
  // How far the slope at the finest step is from the order.
  const double ratio = std::pow(law.smallest / law.crossing, law.p - law.q);
  fit.spread = (law.p - law.q) * ratio / (1.0 - ratio);
  fit.scatter = law.scatter;
  fit.constant = -law.b;
  fit.first_level = range.tracked;
  fit.last_level = range.clear;
  fit.largest_step = law.crossing;
  fit.smallest_step = law.smallest;
  return shows(fit, behaviour_of_order(law.q, context), Code("errors-cancel").name());
}

}  // namespace

RuleResult cancellation(const Range& range, const FitContext& context) {
  const auto law = best_law(range);
  if (!law || law->octaves_of_p() < 1.0) return {};
  if (law->q == 0.0 && law->octaves_of_q() >= octaves_to_floor)
    return dips_to_floor(range, context, *law);
  if (law->q > 0.0 && law->octaves_of_q() >= octaves_to_order)
    return lower_term(range, context, *law);
  auto fit = undecided(range, "errors-cancel");
  fit.cancel_step = law->crossing;
  return fit;
}

RuleResult grows_again(const Range& range, const FitContext&) {
  int least = range.first;
  for (int i = range.first; i <= range.clear; ++i)
    if (range.level(i).error < range.level(least).error) least = i;
  if (least == range.first || least == range.clear) return {};
  const auto tail = window(range.levels, least, range.clear);
  if (!tail || range.level(range.clear).error < straight_scatter * range.level(least).error ||
      !std::ranges::all_of(tail->rates, [](double rate) { return rate < 0.0; }))
    return {};
  return undecided(range, "error-grows-again");
}

}  // namespace clackers::judge
