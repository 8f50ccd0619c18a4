#include "clackers/judge/convergence/fit/window.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace clackers::judge {
namespace {

std::optional<numerics::LineFit> line_through(const RawPoints& points) {
  if (points.x.size() < 2) return {};
  const auto [lowest, highest] = std::ranges::minmax(points.x);
  if (lowest == highest) return {};
  return numerics::fit_line(points.x, points.y);
}

// Takes out the point furthest from the line while that is one far below it; `most` of them.
std::optional<numerics::LineFit> line_without_low_outliers(RawPoints points, std::size_t most) {
  auto line = line_through(points);
  for (std::size_t taken = 0; line && taken < most; ++taken) {
    const bool below = line->largest_below > line->largest_above;
    if (!below || line->largest_below <= std::log(straight_scatter)) break;
    std::size_t lowest = 0;
    for (std::size_t i = 1; i < points.x.size(); ++i)
      if (points.y[i] - line->at(points.x[i]) < points.y[lowest] - line->at(points.x[lowest]))
        lowest = i;
    points.x.erase(points.x.begin() + std::ptrdiff_t(lowest));
    points.y.erase(points.y.begin() + std::ptrdiff_t(lowest));
    line = line_through(points);
  }
  return line;
}

}  // namespace

std::optional<Window> window(std::span<const LevelView> levels, int first, int last) {
  for (int i = first; i <= last; ++i)
    if (i < 0 || !levels[std::size_t(i)].usable) return {};
  const auto all = raw_points(levels, first, last);
  const auto line = line_without_low_outliers(all, all.x.size() / outlier_share);
  if (!line) return {};
  Window found{.first = first, .last = last, .line = *line, .rates = {}, .rate_errors = {}};
  found.points = int(all.x.size());
  found.largest_step = std::exp(all.x.front());
  found.smallest_step = std::exp(all.x.back());
  double furthest = 0.0;
  for (std::size_t i = 0; i < all.x.size(); ++i) {
    const double residual = all.y[i] - line->at(all.x[i]);
    furthest = std::max(furthest, std::abs(residual));
    found.far_above += residual > std::log(straight_scatter);
    found.far_below += residual < -std::log(straight_scatter);
  }
  found.scatter = std::exp(furthest);
  for (int i = first; i < last; ++i) {
    const auto two = raw_points(levels, i, i + 1);
    const auto rate = line_without_low_outliers(two, two.x.size() / outlier_share);
    if (!rate) return {};
    found.rates.push_back(rate->slope);
    found.rate_errors.push_back(rate->slope_error);
  }
  return found;
}

bool is_straight(const Window& window, const Straightness& asked) {
  const int above_allowed = asked.outliers_of > 0 ? window.points / asked.outliers_of : 0;
  if (window.far_above > above_allowed || outlier_share * window.far_below > window.points)
    return false;
  const double centre = asked.around_slope ? window.line.slope : asked.centre;
  const auto near = [&](double rate) { return std::abs(rate - centre) <= asked.rates; };
  return std::ranges::all_of(window.rates, near);
}

std::optional<Window> longest_straight(std::span<const LevelView> levels, int first, int last,
                                       Straightness asked) {
  const double whole = asked.rates;
  for (const double share : {1.0 / 3.0, 1.0}) {
    asked.rates = share * whole;
    for (int from = first; from + shortest_window - 1 <= last; ++from) {
      auto candidate = window(levels, from, last);
      if (candidate && is_straight(*candidate, asked)) return candidate;
    }
  }
  return {};
}

bool may_still_reach(double claimed, const Window& found) {
  if (!(claimed > 0.0)) return false;
  const auto& rates = found.rates;
  const auto& errors = found.rate_errors;
  const auto n = rates.size();
  const double way = claimed > found.line.slope ? 1.0 : -1.0;
  const auto short_of = [&](double rate) { return way * (claimed - rate) > 0.1 * claimed; };
  // A slope that its own uncertainty carries into the tolerance contradicts nothing.
  if (!short_of(found.line.slope + way * found.line.slope_spread) || !short_of(rates[n - 1]))
    return true;
  const double move = way * (rates[n - 1] - rates[n - 2]);
  const double before = way * (rates[n - 2] - rates[n - 3]);
  if (move > least_move && before > least_move) return true;
  const bool significant = move > significant_move * (errors[n - 1] + errors[n - 2]) &&
                           before > significant_move * (errors[n - 2] + errors[n - 3]);
  if (!significant) return false;
  // Moves that do not shrink go on past any bound; those that do add up like a geometric series.
  return move >= before || !short_of(rates[n - 1] + way * move * move / (before - move));
}

bool rates_rise(double claimed, const Window& found) {
  const auto& rates = found.rates;
  const auto n = rates.size();
  return n >= 3 && rates[n - 3] > std::max(claimed, 0.0) &&
         rates[n - 2] - rates[n - 3] > straight_rates &&
         rates[n - 1] - rates[n - 2] > straight_rates;
}

double drift(const Window& found) {
  const auto& rates = found.rates;
  const auto n = rates.size();
  const bool one_way =
      std::ranges::is_sorted(rates) || std::ranges::is_sorted(rates, std::greater{});
  if (!one_way || n == 0) return 0.0;
  const double rest = n > 1 ? 2.0 * (rates[n - 1] - rates[n - 2]) : 0.0;
  return std::max(std::abs(rates[n - 1] + rest - found.line.slope),
                  std::abs(rates.front() - found.line.slope));
}

}  // namespace clackers::judge
