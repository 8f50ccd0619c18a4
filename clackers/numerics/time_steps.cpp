#include "clackers/numerics/time_steps.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace clackers::numerics {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Numbers between which the median of a long list certainly lies: mostly not far from each other.
struct Bracket {
  double low = -infinity, high = infinity;
};

Bracket bracket_of(std::span<const double> times) {
  constexpr std::size_t sample_size = 4096;
  const auto stride = times.size() / sample_size;
  std::vector<double> sample;
  for (std::size_t i = 1; stride > 0 && i < times.size(); i += stride)
    sample.push_back(times[i] - times[i - 1]);
  if (sample.empty()) return {};
  std::ranges::sort(sample);
  // Six standard deviations of the rank of the median on both sides.
  return {sample[sample.size() * 45 / 100], sample[sample.size() * 55 / 100]};
}

}  // namespace

TimeSteps time_steps(std::span<const double> times) {
  for (auto [low, high] = bracket_of(times);; low = -infinity, high = infinity) {
    TimeSteps steps{0.0, infinity, 0.0};
    std::size_t count = 0, below = 0, at_low = 0, at_high = 0;
    std::vector<double> between;  // few, since equidistant times have few different steps
    for (std::size_t i = 1; i < times.size(); ++i) {
      const double step = times[i] - times[i - 1];
      if (!(step > 0.0)) continue;
      ++count;
      steps.least = std::min(steps.least, step);
      steps.most = std::max(steps.most, step);
      below += step < low;
      at_low += step == low;
      at_high += step == high && low < high;
      if (step > low && step < high) between.push_back(step);
    }
    auto rank = count / 2;
    if (rank < below) continue;
    rank -= below;
    if (rank >= at_low + between.size() + at_high) continue;
    if (rank < at_low) {
      steps.median = low;
    } else if (rank -= at_low; rank < between.size()) {
      const auto middle = between.begin() + std::ptrdiff_t(rank);
      std::ranges::nth_element(between, middle);
      steps.median = *middle;
    } else {
      steps.median = high;
    }
    return steps;
  }
}

}  // namespace clackers::numerics
