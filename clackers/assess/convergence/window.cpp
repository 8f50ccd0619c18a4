#include "clackers/assess/convergence/window.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::assess {
namespace {

struct Cloud {
  std::vector<double> x, y;
};

Cloud gather(std::span<const LevelView> levels, int first, int last) {
  Cloud all;
  for (int i = first; i <= last; ++i) {
    const auto& level = levels[std::size_t(i)];
    all.x.insert(all.x.end(), level.x.begin(), level.x.end());
    all.y.insert(all.y.end(), level.y.begin(), level.y.end());
  }
  return all;
}

std::optional<numerics::LineFit> line_through(const Cloud& cloud) {
  if (cloud.x.size() < 2) return {};
  const auto [lowest, highest] = std::ranges::minmax(cloud.x);
  if (lowest == highest) return {};
  return numerics::fit_line(cloud.x, cloud.y);
}

// Takes out the point furthest from the line while that is one far below it; `most` of them.
std::optional<numerics::LineFit> line_without_luck(Cloud cloud, std::size_t most) {
  auto line = line_through(cloud);
  for (std::size_t taken = 0; line && taken < most; ++taken) {
    const bool below = line->largest_below > line->largest_above;
    if (!below || line->largest_below <= std::log(straight_scatter)) break;
    std::size_t lowest = 0;
    for (std::size_t i = 1; i < cloud.x.size(); ++i)
      if (cloud.y[i] - line->at(cloud.x[i]) < cloud.y[lowest] - line->at(cloud.x[lowest]))
        lowest = i;
    cloud.x.erase(cloud.x.begin() + std::ptrdiff_t(lowest));
    cloud.y.erase(cloud.y.begin() + std::ptrdiff_t(lowest));
    line = line_through(cloud);
  }
  return line;
}

}  // namespace

std::optional<Window> window(std::span<const LevelView> levels, int first, int last) {
  for (int i = first; i <= last; ++i)
    if (i < 0 || !levels[std::size_t(i)].usable) return {};
  const auto all = gather(levels, first, last);
  const auto line = line_without_luck(all, all.x.size() / luck_share);
  if (!line) return {};
  Window found{.first = first, .last = last, .line = *line, .rates = {}, .rate_errors = {}};
  found.points = int(all.x.size());
  double furthest = 0.0;
  for (std::size_t i = 0; i < all.x.size(); ++i) {
    const double residual = all.y[i] - line->at(all.x[i]);
    furthest = std::max(furthest, std::abs(residual));
    found.far_above += residual > std::log(straight_scatter);
    found.far_below += residual < -std::log(straight_scatter);
  }
  found.scatter = std::exp(furthest);
  for (int i = first; i < last; ++i) {
    const auto two = gather(levels, i, i + 1);
    const auto rate = line_without_luck(two, two.x.size() / luck_share);
    if (!rate) return {};
    found.rates.push_back(rate->slope);
    found.rate_errors.push_back(rate->slope_error);
  }
  return found;
}

bool is_straight(const Window& window, const Straightness& asked) {
  const int above_allowed = asked.outliers_of > 0 ? window.points / asked.outliers_of : 0;
  if (window.far_above > above_allowed || luck_share * window.far_below > window.points)
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

}  // namespace clackers::assess
