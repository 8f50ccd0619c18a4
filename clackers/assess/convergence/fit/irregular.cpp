#include "clackers/assess/convergence/fit/irregular.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "clackers/assess/convergence/fit/two_terms.hpp"
#include "clackers/assess/convergence/fit/window.hpp"
#include "clackers/assess/errors/vectors.hpp"

namespace clackers::assess {
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
  const double slope = median(slopes);
  for (std::size_t i = 0; i < x.size(); ++i) heights.push_back(y[i] - slope * x[i]);
  return std::abs(heights.front() - median(heights)) > std::log(leading_level);
}

// Half the 95 % interval of a slope through the largest of n errors a level that scatter evenly (in
// logarithms) by the factor f: their logarithm has the variance n / ((n+1)^2 (n+2)) ln^2 f. What few
// levels happen to leave of the line says less.
double spread_of_largest(std::span<const LevelView> levels, const Envelope& found) {
  double runs = 0.0, mean = 0.0, squares = 0.0;
  const double count = found.last - found.first + 1;
  for (int i = found.first; i <= found.last; ++i) {
    runs += double(levels[std::size_t(i)].x.size()) / count;
    mean += std::log(levels[std::size_t(i)].step) / count;
  }
  for (int i = found.first; i <= found.last; ++i)
    squares += std::pow(std::log(levels[std::size_t(i)].step) - mean, 2);
  const double share = std::sqrt(runs / (runs + 2.0)) / (runs + 1.0);
  constexpr double normal95 = 1.96;
  return normal95 * share * std::log(found.scatter) / std::sqrt(squares);
}

// The largest errors of an envelope, a level each.
std::vector<LevelView> largest_of(std::span<const LevelView> levels, const Envelope& found) {
  std::vector<LevelView> largest;
  for (int i = found.first; i <= found.last; ++i) {
    LevelView one;
    one.x = {std::log(levels[std::size_t(i)].step)};
    one.y = {std::log(levels[std::size_t(i)].error)};
    largest.push_back(std::move(one));
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

// The order above a floor where  a h^p + c  describes the envelope better than its line (Akaike: one
// parameter more); 0 otherwise.
double order_above_floor(std::span<const LevelView> levels, const Envelope& found) {
  const auto largest = largest_of(levels, found);
  const auto law = fit_two_terms(largest, 0, int(largest.size()) - 1, {});
  if (!law) return 0.0;
  const auto [of_line, of_law] = squares_of(largest, found, *law);
  constexpr double akaike = 2.0;
  return double(largest.size()) * std::log(of_line / of_law) > akaike ? law->p : 0.0;
}

// The whole order k where the envelope lies significantly above k, by half at most, and the blend
// a h^k + b h^(k+1) is within the 95 % region about the line; 0 otherwise.
double order_of_blend(std::span<const LevelView> levels, const Envelope& found) {
  const double slope = found.line.slope, lower = std::floor(slope);
  if (lower < 1.0 || slope - lower <= found.line.slope_spread || slope - lower > 0.5) return 0.0;
  const auto largest = largest_of(levels, found);
  const auto law =
      fit_two_terms(largest, 0, int(largest.size()) - 1, {.p = lower + 1.0, .q = lower});
  if (!law) return 0.0;
  const auto [of_line, of_law] = squares_of(largest, found, *law);
  const int freedom = int(largest.size()) - 2;
  const double t = numerics::student_t95(freedom);
  return of_law <= of_line * (1.0 + t * t / freedom) ? lower : 0.0;
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
  std::vector<double> x, y;
  for (int i = first; i <= last; ++i) {
    const auto& level = levels[std::size_t(i)];
    x.insert(x.end(), level.x.begin(), level.x.end());
    y.insert(y.end(), level.y.begin(), level.y.end());
  }
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
  found.spread = std::max(found.line.slope_spread, spread_of_largest(levels, found));
  if (const double lower = order_of_blend(levels, found); lower > 0.0)
    found.spread = std::max(found.spread, found.order - lower);
  if (const double above = order_above_floor(levels, found); above > 0.0)
    found.spread = std::max(found.spread, above - found.order);
  return found;
}

}  // namespace clackers::assess
