#include "clackers/judge/convergence/step_ladder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "clackers/base/error.hpp"

namespace clackers::judge {
namespace {

std::vector<double> geometric(double ratio, int count, double first = 0.02) {
  std::vector<double> steps;
  for (int i = 0; i < count; ++i) steps.push_back(first * std::pow(ratio, -i));
  return steps;
}

std::vector<std::size_t> sizes(std::span<const double> steps) {
  std::vector<std::size_t> found;
  for (const auto& level : levels_of_steps(steps)) found.push_back(level.size());
  return found;
}

using Sizes = std::vector<std::size_t>;

TEST(StepLevels, EqualRatiosFillOctaves) {
  EXPECT_EQ(sizes(geometric(std::sqrt(2.0), 10)), Sizes({2, 2, 2, 2, 2}));
  EXPECT_EQ(sizes(geometric(std::exp2(0.25), 20)), Sizes({4, 4, 4, 4, 4}));
  EXPECT_EQ(sizes(geometric(std::exp2(0.125), 16)), Sizes({8, 8}));
  EXPECT_EQ(sizes(geometric(std::exp2(1.0 / 3.0), 7)), Sizes({3, 3, 1}));
}

TEST(StepLevels, StepsAnOctaveOrMoreApartAreOneLevelEach) {
  for (const double ratio : {1.9, 2.0, 2.1, 3.0, 4.0, 10.0})
    EXPECT_EQ(sizes(geometric(ratio, 5)), Sizes({1, 1, 1, 1, 1})) << ratio;
}

TEST(StepLevels, RatiosBetweenShareOctavesWithoutAWiderLevel) {
  for (const double ratio : {1.2, 1.25, 1.5, 1.6, 1.7}) {
    const auto steps = geometric(ratio, 12);
    for (const auto& level : levels_of_steps(steps))
      EXPECT_LT(steps[level.front()] / steps[level.back()], 2.0) << ratio;
  }
}

TEST(StepLevels, WholeNumbersOfStepsChangeNoLevel) {
  for (const int samples : {1, 2, 3, 4, 8})
    for (int shift = 0; shift < 40; ++shift) {
      std::vector<double> steps;
      for (int i = 0; i < 5 * samples; ++i)
        steps.push_back(20.0 / std::round((300.0 + shift) * std::exp2(double(i) / samples)));
      EXPECT_EQ(sizes(steps), Sizes(5, std::size_t(samples))) << samples << ' ' << shift;
    }
}

TEST(StepLevels, StepsATenthOfTheWayToTheirNeighboursChangeNoLevel) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> way(-0.1, 0.1);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> steps;
    for (int i = 0; i < 40; ++i) steps.push_back(0.05 * std::exp2(-(i + way(random)) / 8.0));
    EXPECT_EQ(sizes(steps), Sizes(5, 8)) << trial;
  }
}

TEST(StepLevels, RandomStepsFillOctavesInOrder) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> octaves(0.0, 5.0);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> steps;
    for (int i = 0; i < 20; ++i) steps.push_back(0.02 * std::exp2(-octaves(random)));
    const auto levels = levels_of_steps(steps);
    EXPECT_LE(levels.size(), 6u);
    double before = 1.0;
    std::size_t count = 0;
    for (const auto& level : levels) {
      count += level.size();
      EXPECT_LT(steps[level.front()] / steps[level.back()], 2.0);
      for (const auto i : level) {
        EXPECT_LE(steps[i], before);
        before = steps[i];
      }
    }
    EXPECT_EQ(count, steps.size());
  }
}

TEST(StepLevels, EqualStepsShareALevel) {
  const std::vector<double> steps{0.01, 0.02, 0.01, 0.005};
  const std::vector<std::vector<std::size_t>> expected{{1}, {0, 2}, {3}};
  EXPECT_EQ(levels_of_steps(steps), expected);
}

TEST(StepLevels, NoStepsAreNoLevels) { EXPECT_TRUE(levels_of_steps({}).empty()); }

TEST(StepLevels, AStepThatIsNotPositiveIsRefused) {
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    const std::vector<double> steps{0.1, bad};
    EXPECT_THROW(levels_of_steps(steps), InputError);
  }
}

}  // namespace
}  // namespace clackers::judge
