#include "clackers/assess/convergence/fit/window.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/assess/testing/synthetic_ladder.hpp"

namespace clackers::assess {
namespace {

using namespace synthetic;

TEST(Window, HasTheLineAndARateForEachTwoLevels) {
  const auto levels = view(ladder([](double h) { return 5.0 * h * h; }));
  const auto found = window(levels, 2, 6);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->levels(), 5);
  EXPECT_EQ(found->points, 40);
  EXPECT_NEAR(found->line.slope, 2.0, 1e-12);
  ASSERT_EQ(found->rates.size(), 4u);
  for (const double rate : found->rates) EXPECT_NEAR(rate, 2.0, 1e-12);
  EXPECT_NEAR(found->scatter, 1.0, 1e-12);
}

TEST(Window, IsNoneOverALevelThatFailedOrIsNotThere) {
  auto made = ladder([](double h) { return h; });
  for (auto& point : made[3]) point.error = nan;
  const auto levels = view(made);
  EXPECT_FALSE(window(levels, 2, 5).has_value());
  EXPECT_TRUE(window(levels, 4, 7).has_value());
  EXPECT_FALSE(window(levels, -1, 2).has_value());
  EXPECT_FALSE(window(view(ladder([](double) { return 0.0; })), 0, 3).has_value());
}

TEST(Window, CountsPointsFarFromTheLineOnEitherSide) {
  auto made = ladder([](double h) { return h; }, {.levels = 4});
  made[1][3].error *= 4.0;
  made[2][5].error /= 100.0;
  const auto found = window(view(made), 0, 3);
  EXPECT_EQ(found->far_above, 1);
  EXPECT_EQ(found->far_below, 1);
  EXPECT_NEAR(found->scatter, 100.0, 10.0);
  // The point that lies too low does not pull, the one too high does.
  EXPECT_GT(found->line.at(0.0), 0.02);
  EXPECT_FALSE(is_straight(*found, {}));
  EXPECT_TRUE(is_straight(*found, {.outliers_of = 16}));
}

TEST(Window, MoreLuckThanOnePointInSixteenIsNoLine) {
  auto made = ladder([](double h) { return h; }, {.levels = 4});
  made[0][2].error *= 1e-6;
  made[2][2].error *= 1e-6;
  EXPECT_TRUE(is_straight(*window(view(made), 0, 3), {}));
  made[3][6].error *= 1e-6;
  EXPECT_FALSE(is_straight(*window(view(made), 0, 3), {}));
}

TEST(Window, RatesAreComparedWithTheSlopeOrWithAGivenCentre) {
  const auto line = *window(view(ladder([](double h) { return std::pow(h, 1.85); })), 0, 3);
  EXPECT_TRUE(is_straight(line, {.rates = 0.1}));
  EXPECT_TRUE(is_straight(line, {.rates = 0.2, .around_slope = false, .centre = 2.0}));
  EXPECT_FALSE(is_straight(line, {.rates = 0.1, .around_slope = false, .centre = 2.0}));
  const auto bent =
      *window(view(ladder([](double h) { return h * h + 3.0 * h * h * h / 0.05; })), 0, 7);
  EXPECT_FALSE(is_straight(bent, {.rates = 0.2}));
}

TEST(Window, TheLongestStraightOneLeavesTheBendOutWhereItCan) {
  const auto levels = view(ladder([](double h) { return h * h + 500.0 * h * h * h * h; }));
  const auto found =
      longest_straight(levels, 0, 7, {.rates = 0.2, .around_slope = false, .centre = 2.0});
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->last, 7);
  for (const double rate : found->rates) EXPECT_NEAR(rate, 2.0, 0.2 / 3.0);
  // One level more would not be as straight.
  const auto longer = window(levels, found->first - 1, 7);
  EXPECT_GT(longer->rates.front(), 2.0 + 0.2 / 3.0);
}

TEST(Window, FewerThanFourLevelsAreNone) {
  const auto levels = view(ladder([](double h) { return h; }));
  EXPECT_FALSE(longest_straight(levels, 5, 7, {}).has_value());
  EXPECT_TRUE(longest_straight(levels, 4, 7, {}).has_value());
}

}  // namespace
}  // namespace clackers::assess
