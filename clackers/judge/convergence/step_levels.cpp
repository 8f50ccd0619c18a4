#include "clackers/judge/convergence/step_ladder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "clackers/base/check.hpp"

namespace clackers::judge {
namespace {

// Rounding of log2 of two steps: steps nearer than this, in octaves, are one.
constexpr double same_place = 1e-9;

// How far above the largest step the octaves begin, in octaves, 0 to 1: the middle of a gap of the
// fractional parts of `below`, the octaves from the largest step down to each.
double begin_of_octaves(const std::vector<double>& below) {
  std::vector<double> places;
  for (const double octaves : below) {
    const double place = octaves - std::floor(octaves);
    places.push_back(place > 1.0 - same_place ? 0.0 : place);
  }
  std::ranges::sort(places);
  places.push_back(1.0);
  double widest = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i)
    widest = std::max(widest, places[i] - places[i - 1]);
  for (std::size_t i = places.size() - 1; i > 0; --i)
    if (places[i] - places[i - 1] >= 0.5 * widest) return 1.0 - 0.5 * (places[i] + places[i - 1]);
  return 0.5;
}

}  // namespace

std::vector<std::vector<std::size_t>> levels_of_steps(std::span<const double> steps) {
  for (const double step : steps) require_step("levels of steps", step);
  std::vector<std::size_t> order(steps.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return steps[i]; });
  std::vector<double> below;
  for (const auto i : order) below.push_back(std::log2(steps[order.front()] / steps[i]));
  const double begin = below.empty() ? 0.0 : begin_of_octaves(below);
  std::vector<std::vector<std::size_t>> levels;
  double octave = -1.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double here = std::floor(below[i] + begin);
    if (here > octave) levels.emplace_back();
    octave = here;
    levels.back().push_back(order[i]);
  }
  return levels;
}

}  // namespace clackers::judge
