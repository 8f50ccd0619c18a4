#include "clackers/judge/convergence/fit/range.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "clackers/numerics/line_fit.hpp"

namespace clackers::judge {
namespace {

constexpr std::size_t fewest_to_bend = 4;

// Sizes of the second term at the largest step: from one that cancels three quarters of the first to
// one that rules until the finest of six levels.
constexpr double smallest_term = -0.75, largest_term = 64.0;

struct Bent {
  double squares = 0.0;
  numerics::LineFit line;
};

Bent bent(std::span<const double> x, std::span<const double> y, double largest, double term) {
  std::vector<double> straightened(y.begin(), y.end());
  for (std::size_t i = 0; i < x.size(); ++i)
    straightened[i] -= std::log1p(term * std::exp(x[i] - largest));
  Bent found{.line = numerics::fit_line(x, straightened)};
  const double freedom = double(x.size()) - 2.0;
  const double centre = [&] {
    double sum = 0.0;
    for (const double here : x) sum += here;
    return sum / double(x.size());
  }();
  double sxx = 0.0;
  for (const double here : x) sxx += (here - centre) * (here - centre);
  found.squares = found.line.slope_error * found.line.slope_error * freedom * sxx;
  return found;
}

}  // namespace

double OrderInterval::half_width() const {
  // What the law gains on the average of points that scatter about a line: chi-square of one freedom.
  constexpr double by_chance = 1.0;
  return gain > by_chance ? spread + std::max(std::abs(limit - slope), std::abs(coarsest - slope))
                          : spread;
}

OrderInterval order_interval(std::span<const double> x, std::span<const double> y) {
  const auto line = numerics::fit_line(x, y);
  OrderInterval found{.slope = line.slope,
                      .spread = line.slope_spread,
                      .limit = line.slope,
                      .coarsest = line.slope};
  if (x.size() < fewest_to_bend) return found;
  const double largest = std::ranges::max(x);
  // 1 + term in equal ratios, then finer about the best of them and about none: between small terms
  // and large ones, which bend all rates by as much, the squares rise again.
  const auto at = [&](double place) { return bent(x, y, largest, std::exp(place) - 1.0); };
  const double low = std::log1p(smallest_term), high = std::log1p(largest_term);
  constexpr int places = 16;
  const double width = (high - low) / places, straight = at(0.0).squares;
  double best = 0.0, least = straight;
  const auto improve = [&](double place) {
    const double here = at(place).squares;
    if (here < least) {
      least = here;
      best = place;
    }
  };
  const auto refine = [&] {
    for (double step = 0.5 * width; step > width / 128.0; step *= 0.5)
      for (const double place : {best - step, best + step}) improve(std::clamp(place, low, high));
  };
  refine();
  for (int i = 0; i <= places; ++i) improve(low + i * width);
  refine();
  const auto law = at(best);
  found.limit = law.line.slope;
  const double term = std::exp(best) - 1.0;
  found.coarsest = found.limit + term / (1.0 + term);
  // Exact points bend by their rounding alone.
  constexpr double rounding = 1e-24;
  if (straight > rounding * double(x.size()))
    found.gain = double(x.size()) * std::log(straight / std::max(least, 1e-300));
  return found;
}

}  // namespace clackers::judge
