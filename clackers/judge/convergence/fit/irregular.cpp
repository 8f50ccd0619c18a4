#include "clackers/judge/convergence/fit/irregular.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "clackers/judge/convergence/fit/range.hpp"
#include "clackers/judge/convergence/fit/two_terms.hpp"
#include "clackers/judge/convergence/fit/window.hpp"
#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::judge {
namespace {

// How far each inner point lies above the chord of its two neighbours.
std::vector<double> bends(std::span<const double> x, std::span<const double> y) {
  std::vector<double> found;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const double share = (x[i] - x[i - 1]) / (x[i + 1] - x[i - 1]);
    found.push_back(y[i] - (y[i - 1] + share * (y[i + 1] - y[i - 1])));
  }
  return found;
}

numerics::LineFit line_of_largest(std::span<const LevelView> levels, int first, int last) {
  std::vector<double> x, y;
  for (int i = first; i <= last; ++i) {
    x.push_back(std::log(levels[std::size_t(i)].step));
    y.push_back(std::log(levels[std::size_t(i)].error));
  }
  return numerics::fit_line(x, y);
}

// Whether the coarsest level lies more than a factor `leading_level` off the line of medians (Theil
// and Sen), to which two levels of eight that lie elsewhere do nothing.
bool first_lies_off(std::span<const LevelView> levels, int first, int last) {
  std::vector<double> x, y, slopes, heights;
  for (int i = first; i <= last; ++i) {
    x.push_back(std::log(levels[std::size_t(i)].step));
    y.push_back(std::log(levels[std::size_t(i)].error));
  }
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) slopes.push_back((y[i] - y[j]) / (x[i] - x[j]));
  const double slope = measure::median(slopes);
  for (std::size_t i = 0; i < x.size(); ++i) heights.push_back(y[i] - slope * x[i]);
  return std::abs(heights.front() - measure::median(heights)) > std::log(leading_level);
}

// Half the 95 % interval of the slope through the largest errors. What few levels leave of the line
// is a poor measure of their deviation, so it is pooled with the one that the raw errors suggest: the
// logarithm of the largest of n errors that scatter evenly over a range f (a deviation of
// ln f / sqrt(12)) has the variance n / ((n+1)^2 (n+2)) ln^2 f. The prior weighs as much as two
// degrees of freedom, with which the intervals of coverage_test.cpp hold 95 in 100 orders of
// lognormal errors, and more of others.
double spread_of_largest(std::span<const LevelView> levels, const Envelope& found) {
  constexpr double weight = 2.0;
  const double levels_used = found.last - found.first + 1;
  const auto raw = raw_points(levels, found.first, found.last);
  const double count = double(raw.x.size()), runs = count / levels_used;
  double centre = 0.0, spread_of_steps = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < raw.x.size(); ++i) {
    const double off = raw.y[i] - found.line.at(raw.x[i]);
    sum += off;
    squares += off * off;
  }
  for (int i = found.first; i <= found.last; ++i)
    centre += std::log(levels[std::size_t(i)].step) / levels_used;
  for (int i = found.first; i <= found.last; ++i)
    spread_of_steps += std::pow(std::log(levels[std::size_t(i)].step) - centre, 2);
  const double range_squared = 12.0 * (squares - sum * sum / count) / std::max(1.0, count - 2.0);
  const double of_largest = runs / ((runs + 1.0) * (runs + 1.0) * (runs + 2.0)) * range_squared;
  const double freedom = levels_used - 2.0;
  const double seen = found.line.slope_error * found.line.slope_error;
  const double pooled =
      (freedom * seen + weight * of_largest / spread_of_steps) / (freedom + weight);
  return numerics::student_t95(int(freedom + weight)) * std::sqrt(pooled);
}

// The largest errors of an envelope, a level each.
std::vector<LevelView> largest_of(std::span<const LevelView> levels, const Envelope& found) {
  std::vector<LevelView> largest;
  for (int i = found.first; i <= found.last; ++i) {
    LevelView level;
    level.x = {std::log(levels[std::size_t(i)].step)};
    level.y = {std::log(levels[std::size_t(i)].error)};
    largest.push_back(std::move(level));
  }
  return largest;
}

// What the line and a law leave of the largest errors.
std::pair<double, double> squares_of(const std::vector<LevelView>& largest, const Envelope& found,
                                     const TwoTerms& law) {
  double of_line = 0.0, of_law = 0.0;
  for (const auto& level : largest) {
    const double x = level.x.front(), y = level.y.front();
    of_line += std::pow(y - found.line.at(x), 2);
    of_law += std::pow(y - std::log(law.error_at(std::exp(x))), 2);
  }
  return {of_line, of_law};
}

// The whole order k where the envelope lies significantly above k, by half at most, and the blend
// a h^k + b h^(k+1) follows the largest errors better than their line does; 0 otherwise.
double order_of_blend(std::span<const LevelView> levels, const Envelope& found) {
  const double slope = found.line.slope, lower = std::floor(slope);
  if (lower < 1.0 || slope - lower <= found.line.slope_spread || slope - lower > 0.5) return 0.0;
  const auto largest = largest_of(levels, found);
  const auto law =
      fit_two_terms(largest, 0, int(largest.size()) - 1, {.p = lower + 1.0, .q = lower});
  if (!law) return 0.0;
  const auto [of_line, of_law] = squares_of(largest, found, *law);
  return of_law <= of_line ? lower : 0.0;
}

}  // namespace

bool zigzags(std::span<const LevelView> levels, int first, int last) {
  std::vector<double> x, y;
  for (int i = last; i >= first && (last - i < shortest_window || std::ssize(x) < enough_points);
       --i) {
    const auto& level = levels[std::size_t(i)];
    x.insert(x.begin(), level.x.begin(), level.x.end());
    y.insert(y.begin(), level.y.begin(), level.y.end());
  }
  const auto bend = bends(x, y);
  const double least = std::log(zigzag_bend);
  int places = 0, zigs = 0;
  for (std::size_t i = 1; i < bend.size(); ++i) {
    ++places;
    zigs +=
        bend[i] * bend[i - 1] < 0.0 && std::min(std::abs(bend[i]), std::abs(bend[i - 1])) > least;
  }
  return zigs >= least_turns && zigs > zigzag_share * places;
}

bool swings(std::span<const LevelView> levels, int first, int last) {
  const auto [x, y] = raw_points(levels, first, last);
  if (std::ssize(x) < enough_points) return false;
  const auto line = numerics::fit_line(x, y);
  const double least = 0.5 * std::log(straight_scatter);
  int turns = 0;
  double side = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - line.at(x[i]);
    if (std::abs(residual) <= least) continue;
    turns += side * residual < 0.0;
    side = residual;
  }
  return turns >= least_turns;
}

std::optional<Envelope> envelope(std::span<const LevelView> levels, int first, int last) {
  for (int i = last; i >= first; --i)
    if (!(levels[std::size_t(i)].usable && levels[std::size_t(i)].error > 0.0)) first = i + 1;
  if (last - first + 1 < shortest_window) return {};
  while (last - first + 1 > shortest_window && first_lies_off(levels, first, last)) ++first;
  Envelope found{.first = first, .last = last, .line = line_of_largest(levels, first, last)};
  double furthest = 0.0;
  for (int i = first; i <= last; ++i) {
    const auto& level = levels[std::size_t(i)];
    for (std::size_t j = 0; j < level.x.size(); ++j)
      furthest = std::max(furthest, std::abs(level.y[j] - found.line.at(level.x[j])));
  }
  found.scatter = std::exp(furthest);
  found.order = found.line.slope;
  found.spread = spread_of_largest(levels, found);
  if (const double lower = order_of_blend(levels, found); lower > 0.0) {
    found.spread = std::max(found.spread, found.order - lower);
    found.order = lower;
  }
  return found;
}

}  // namespace clackers::judge
