#include <algorithm>
#include <cmath>
#include <numeric>

#include "clackers/base/codes.hpp"
#include "clackers/judge/convergence/fit/rules.hpp"
#include "clackers/judge/convergence/fit/two_terms.hpp"

namespace clackers::judge {
namespace {

// Runs at a floor within this factor of their trend: the limit of smooth convergence. What noise,
// tolerances and printed digits leave scatters by more.
constexpr double smooth_floor = 1.05;
// A floor that rules this many octaves is seen, not extrapolated: there order one has fallen to a
// quarter of it.
constexpr double octaves_of_floor = 2.0;

double mean(const std::vector<double>& y) {
  return std::accumulate(y.begin(), y.end(), 0.0) / double(y.size());
}

struct Floor {
  double error = 0.0, step = 0.0, scatter = 1.0;
  bool rough = false;
};

LadderFit with_floor(LadderFit fit, const Floor& floor) {
  fit.floor = floor.error;
  fit.floor_step = floor.step;
  fit.floor_scatter = floor.scatter;
  return fit;
}

// Whether the finest runs, four at least, scatter about their own line by more than `smooth_floor`.
bool is_rough(const Range& range, int first, int last) {
  constexpr std::size_t enough = 4;
  int from = last;
  auto points = raw_points(range.levels, from, last);
  while (from > first && (points.x.size() < enough || from == last))
    points = raw_points(range.levels, --from, last);
  if (points.x.size() < enough || points.x.front() == points.x.back()) return false;
  const auto line = numerics::fit_line(points.x, points.y);
  return std::max(line.largest_above, line.largest_below) > std::log(smooth_floor);
}

// The law a h^p + c over the levels up to the finest, where it describes them and p rules three
// octaves.
std::optional<TwoTerms> law_with_floor(const Range& range) {
  const auto law = fit_two_terms(range.levels, range.tracked, range.clear, {});
  constexpr double significant = 3.0, most_uncertain = 0.25;
  if (!law || law->scatter > straight_scatter || law->b < significant * law->b_error ||
      law->octaves_of_p() < shortest_line || law->octaves_of_q() < -1.5 ||
      law->p_spread > most_uncertain * law->p)
    return {};
  return law;
}

bool has_no_trend(const RawPoints& points) {
  if (points.x.size() < 3 || points.x.front() == points.x.back()) return true;
  const auto line = numerics::fit_line(points.x, points.y);
  return std::abs(line.slope) - line.slope_spread < straight_rates;
}

// What the law leaves of the points where the floor rules has no trend.
bool floor_is_flat(const RawPoints& points, const TwoTerms& law) {
  RawPoints below;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    if (std::exp(points.x[i]) >= law.crossing) continue;
    const double off = points.y[i] - std::log(law.error_at(std::exp(points.x[i])));
    below.x.push_back(points.x[i]);
    below.y.push_back(off);
  }
  return has_no_trend(below);
}

// Whether a term of order one that begins to show bends the errors as a floor would, and better. Errors
// nearly as large as the motion, of the coarsest levels, follow neither law.
bool bends_to_order_one(const Range& range) {
  constexpr int levels = 6;
  const int first = std::max(range.tracked, range.clear - levels + 1);
  const auto floor = fit_two_terms(range.levels, first, range.clear, {});
  const auto term = fit_two_terms(range.levels, first, range.clear, {.p = 0.0, .q = 1.0});
  return floor && term && term->scatter < floor->scatter;
}

LadderFit with_law(const Range& range, const TwoTerms& law, Floor floor) {
  auto fit = with_floor(range.blank, floor);
  fit.has_line = true;
  fit.order = law.p;
  fit.spread = law.p_spread;
  fit.scatter = law.scatter;
  fit.constant = law.a;
  fit.first_level = range.tracked;
  fit.last_level = range.clear;
  while (fit.last_level > range.tracked && range.level(fit.last_level).step < law.crossing)
    --fit.last_level;
  fit.largest_step = law.largest;
  fit.smallest_step = std::max(law.crossing, law.smallest);
  return fit;
}

// A line that ends in a rough floor shows the order of the method; one that ends in a smooth floor
// another limit.
Behaviour behaviour_above(const LadderFit& fit, const Floor& floor, const FitContext& context) {
  const bool rough = floor.rough && context.contact_time <= 0.0 && !context.wrong_limit;
  return rough ? behaviour_of_order(fit.order, context) : Behaviour::stagnating;
}

}  // namespace

LadderFit stagnates(const Range& range, const FitContext& context, const Window& flat) {
  const auto points = raw_points(range.levels, flat.first, flat.last);
  Floor floor{.error = std::exp(mean(range.level(flat.last).y)),
              .step = std::exp(points.x.front()),
              .scatter = flat.scatter,
              .rough = context.noise || is_rough(range, flat.first, flat.last)};
  if (floor.error >= context.saturation) return undecided(range, "larger-than-motion");
  const auto reason = floor_reason(context, floor.rough).name();
  if (const auto law = law_with_floor(range)) {
    floor.step = law->crossing;
    const auto fit = with_law(range, *law, floor);
    return shows(fit, behaviour_above(fit, floor, context), reason);
  }
  for (int last = flat.first; last > range.first; --last)
    if (const auto line = line_up_to(range, context, last)) {
      const auto fit = with_floor(with_line(range, *line), floor);
      if (fit.order < lowest_real_order) continue;
      return shows(fit, behaviour_above(fit, floor, context), reason);
    }
  auto fit = with_floor(range.blank, floor);
  fit.scatter = flat.scatter;
  fit.first_level = flat.first;
  fit.last_level = flat.last;
  fit.largest_step = floor.step;
  fit.smallest_step = std::exp(points.x.back());
  return shows(std::move(fit), Behaviour::stagnating, reason);
}

RuleResult plateau(const Range& range, const FitContext& context) {
  const auto tail = range.last(shortest_plateau);
  const Straightness flat{.rates = straight_rates, .around_slope = false, .centre = 0.0};
  if (!tail || !is_straight(*tail, flat)) return {};
  return stagnates(range, context, *tail);
}

RuleResult line_with_floor(const Range& range, const FitContext& context) {
  const auto law = law_with_floor(range);
  const auto points = raw_points(range.levels, range.tracked, range.clear);
  if (!law || !floor_is_flat(points, *law)) return {};
  if (law->p > 1.0 + straight_rates && bends_to_order_one(range)) return {};
  Floor floor{.error = law->b, .step = law->crossing};
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double step = std::exp(points.x[i]);
    if (step > law->crossing) continue;
    const double off = std::abs(points.y[i] - std::log(law->error_at(step)));
    floor.scatter = std::max(floor.scatter, std::exp(off));
  }
  floor.rough = floor.scatter > smooth_floor;
  const auto fit = with_law(range, *law, floor);
  const auto reason = floor_reason(context, floor.rough).name();
  const bool seen = law->octaves_of_q() >= octaves_of_floor && !floor.rough;
  return shows(fit, seen ? Behaviour::stagnating : behaviour_of_order(fit.order, context), reason);
}

RuleResult line_then_rough_floor(const Range& range, const FitContext& context) {
  for (int last = range.clear - 1; last > range.first; --last) {
    const auto line = line_up_to(range, context, last);
    if (!line) continue;
    const auto rest = raw_points(range.levels, last + 1, range.clear);
    if (rest.x.size() < 3 || rest.x.front() == rest.x.back()) continue;
    const auto trend = numerics::fit_line(rest.x, rest.y);
    const double level = mean(rest.y), factor = std::log(2.0);
    const bool flat = trend.slope - trend.slope_spread < highest_flat_slope &&
                      trend.slope + trend.slope_spread > -highest_flat_slope &&
                      trend.slope < 0.5 * line->line.slope;
    const bool leaves_line = mean(range.level(range.clear).y) >
                                 line->line.at(range.level(range.clear).x.front()) + factor &&
                             level < line->line.at(rest.x.front()) + factor;
    if (!flat || !leaves_line ||
        !has_no_trend(raw_points(range.levels, range.clear, range.clear)) ||
        !is_rough(range, last + 1, range.clear))
      continue;
    const Floor floor{.error = std::exp(level),
                      .step = std::exp(rest.x.front()),
                      .scatter = std::exp(std::max(std::ranges::max(rest.y) - level,
                                                   level - std::ranges::min(rest.y))),
                      .rough = true};
    const auto fit = with_floor(with_line(range, *line), floor);
    return shows(fit, behaviour_of_order(fit.order, context), floor_reason(context, true).name());
  }
  return {};
}

}  // namespace clackers::judge
