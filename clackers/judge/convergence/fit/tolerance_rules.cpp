#include <algorithm>
#include <cmath>

#include "clackers/base/codes.hpp"
#include "clackers/judge/convergence/fit/rules.hpp"

namespace clackers::judge {
namespace {

// Errors of adaptive solvers lie within this factor of their line: the error of a step is kept below
// the tolerance, not at it, and adds up as the motion lets it.
constexpr double tolerance_scatter = 10.0;
constexpr std::size_t fewest = 4;

// The place from which the errors stay flat, far above the line of those before; the number of points
// where they do not.
std::size_t begin_of_floor(const RawPoints& points) {
  for (std::size_t from = fewest; from + 2 <= points.x.size(); ++from) {
    const std::span<const double> x(points.x), y(points.y);
    const auto line = numerics::fit_line(x.first(from), y.first(from));
    const auto rest = numerics::fit_line(x.subspan(from), y.subspan(from));
    if (line.slope > straight_rates && std::abs(rest.slope) < highest_flat_slope &&
        y.back() - line.at(x.back()) > std::log(tolerance_scatter))
      return from;
  }
  return points.x.size();
}

}  // namespace

RuleResult tolerance_ladder(const Range& range, const FitContext& context) {
  if (!context.by_tolerance) return {};
  if (range.tracked > range.clear || range.level(range.tracked).error >= context.saturation)
    return undecided(range, "larger-than-motion");
  auto points = raw_points(range.levels, range.tracked, range.clear);
  if (points.x.size() < fewest || octaves_of(points) < shortest_line)
    return undecided(range, "too-few-levels");
  auto fit = range.blank;
  fit.first_level = range.tracked;
  fit.last_level = range.clear;
  const auto end = begin_of_floor(points);
  if (end < points.x.size()) {
    double sum = 0.0;
    for (std::size_t i = end; i < points.y.size(); ++i) sum += points.y[i];
    fit.floor = std::exp(sum / double(points.y.size() - end));
    fit.floor_step = std::exp(points.x[end]);
    fit.reason = floor_reason(context, true).name();
    points.x.resize(end);
    points.y.resize(end);
    while (fit.last_level > range.tracked &&
           range.level(fit.last_level).x.front() < points.x.back())
      --fit.last_level;
  }
  fit.largest_step = std::exp(points.x.front());
  fit.smallest_step = std::exp(points.x.back());
  const auto line = numerics::fit_line(points.x, points.y);
  fit.scatter = std::exp(std::max(line.largest_above, line.largest_below));
  // Above a floor a line falls by more than its uncertainty.
  const bool has_floor = fit.floor > 0.0;
  if (std::abs(line.slope) <= std::max(straight_rates, has_floor ? line.slope_spread : 0.0)) {
    if (!has_floor) fit.floor = std::exp(points.y.back());
    fit.floor_step = fit.largest_step;
    return shows(fit, Behaviour::stagnating, floor_reason(context, true).name());
  }
  if (line.slope < 0.0) return diverges(fit);
  if (fit.scatter > tolerance_scatter) return undecided(range, "no-convergence-yet");
  fit.has_line = true;
  fit.order = line.slope;
  fit.spread = line.slope_spread;
  fit.constant = std::exp(line.intercept);
  const bool lower = line.slope < 1.0 - tolerance_proportional;
  return shows(fit, lower ? Behaviour::reduced : Behaviour::proper, fit.reason);
}

}  // namespace clackers::judge
