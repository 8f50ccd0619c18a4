#include "clackers/numerics/time_steps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace clackers::numerics {
namespace {

void expect_steps(const std::vector<double>& times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] > times[i - 1]) steps.push_back(times[i] - times[i - 1]);
  std::ranges::sort(steps);
  const auto found = time_steps(times);
  EXPECT_EQ(found.median, steps[steps.size() / 2]);
  EXPECT_EQ(found.least, steps.front());
  EXPECT_EQ(found.most, steps.back());
}

std::vector<double> sum_of(std::size_t count, const std::function<double(std::size_t)>& step) {
  std::vector<double> times{1.0};
  while (times.size() < count) times.push_back(times.back() + step(times.size()));
  return times;
}

TEST(TimeSteps, AreThoseOfASortedList) {
  std::mt19937 random(27);  // NOLINT: the same numbers in every run
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (const auto count : std::vector<std::size_t>{2, 3, 4, 100, 4096, 5000, 100000}) {
    expect_steps(sum_of(count, [&](std::size_t) { return any(random); }));
    expect_steps(sum_of(count, [](std::size_t) { return 0.1; }));
    // Rows of one time, and steps of two lengths in nearly equal numbers.
    expect_steps(sum_of(count, [](std::size_t i) { return i % 3 == 2 ? 0.0 : 0.25; }));
    expect_steps(sum_of(count, [](std::size_t i) { return i % 2 == 0 ? 0.25 : 0.5; }));
  }
}

TEST(TimeSteps, AreRightWhereASampleOfThemMisleads) {
  // A sample of every 10th or 20th step has one length, which few have.
  for (const double rare : {0.1, 10.0})
    for (const double other : {1.0, 2.0})
      expect_steps(sum_of(81920, [&](std::size_t i) {
        return i % 10 == 1 ? rare : i % 3 == 0 ? other : 1.5;
      }));
}

}  // namespace
}  // namespace clackers::numerics
