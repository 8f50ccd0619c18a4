#include "clackers/judge/convergence/fit/window.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/judge/testing/synthetic_ladder.hpp"

namespace clackers::judge {
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

TEST(Window, MoreThanOneLowPointInSixteenIsNoLine) {
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

// A window of these rates whose errors are all `error` and whose slope is known to 0.01.
Window by_rates(std::vector<double> rates, double slope, double error) {
  Window made;
  made.line.slope = slope;
  made.line.slope_spread = 0.01;
  made.rate_errors.assign(rates.size(), error);
  made.rates = std::move(rates);
  return made;
}

TEST(RateTrend, WithoutAClaimNothingIsStillReached) {
  EXPECT_FALSE(may_still_reach(0.0, by_rates({1.5, 1.6, 1.7}, 1.6, 0.0)));
}

TEST(RateTrend, ASlopeOrAFinestRateWithinATenthOfTheClaimMayReachIt) {
  EXPECT_TRUE(may_still_reach(2.0, by_rates({1.7, 1.7, 1.81}, 1.7, 1.0)));
  EXPECT_FALSE(may_still_reach(2.0, by_rates({1.7, 1.7, 1.79}, 1.7, 1.0)));
  EXPECT_TRUE(may_still_reach(2.0, by_rates({1.79, 1.79, 1.79}, 1.791, 1.0)));
  EXPECT_FALSE(may_still_reach(2.0, by_rates({1.79, 1.79, 1.79}, 1.789, 1.0)));
}

TEST(RateTrend, LargeMovesTowardsTheClaimCountWhateverTheirErrors) {
  EXPECT_TRUE(may_still_reach(2.0, by_rates({1.5, 1.55, 1.6}, 1.55, 1.0)));
  EXPECT_FALSE(may_still_reach(2.0, by_rates({1.5, 1.55, 1.58}, 1.55, 1.0)));
  EXPECT_FALSE(may_still_reach(2.0, by_rates({1.6, 1.55, 1.5}, 1.55, 1.0)));
  EXPECT_TRUE(may_still_reach(1.0, by_rates({1.6, 1.55, 1.5}, 1.55, 1.0)));
}

TEST(RateTrend, SmallMovesCountWhenTheyAreSignificantAndTheirLimitIsTheClaim) {
  // Moves of 0.03 and 0.024 add up to 0.12: from 0.86 to 0.956 and no further.
  EXPECT_TRUE(may_still_reach(1.0, by_rates({0.806, 0.836, 0.86}, 0.83, 0.003)));
  EXPECT_FALSE(may_still_reach(1.1, by_rates({0.806, 0.836, 0.86}, 0.83, 0.003)));
  EXPECT_FALSE(may_still_reach(1.0, by_rates({0.806, 0.836, 0.86}, 0.83, 0.0045)));
  EXPECT_TRUE(may_still_reach(1.1, by_rates({0.806, 0.83, 0.86}, 0.83, 0.003)));
}

TEST(RateTrend, RatesRiseWhenEachExceedsTheOneBeforeByAFifth) {
  EXPECT_TRUE(rates_rise(2.0, by_rates({1.0, 2.1, 2.4, 2.7}, 2.0, 1.0)));
  EXPECT_TRUE(rates_rise(0.0, by_rates({0.1, 0.4, 0.7}, 0.4, 1.0)));
  EXPECT_FALSE(rates_rise(2.0, by_rates({1.9, 2.4, 2.7}, 2.4, 1.0)));
  EXPECT_FALSE(rates_rise(2.0, by_rates({2.1, 2.4, 2.55}, 2.4, 1.0)));
  EXPECT_FALSE(rates_rise(2.0, by_rates({2.1, 2.25, 2.55}, 2.4, 1.0)));
  EXPECT_FALSE(rates_rise(2.0, by_rates({2.4, 2.7}, 2.4, 1.0)));
}

TEST(RateTrend, DriftIsWhatALineHidesOfABend) {
  EXPECT_NEAR(drift(by_rates({1.6, 1.5, 1.3}, 1.45, 0.0)), 0.55, 1e-12);
  EXPECT_NEAR(drift(by_rates({1.3, 1.5, 1.6}, 1.45, 0.0)), 0.35, 1e-12);
  EXPECT_EQ(drift(by_rates({1.3, 1.6, 1.5}, 1.45, 0.0)), 0.0);
}

TEST(RateTrend, TheErrorsOfRatesAreThoseOfTheirRawPoints) {
  Scatter scatter(1.2, 3);
  const auto rough = *window(view(ladder([&](double h) { return h * scatter(); })), 0, 3);
  const auto smooth = *window(view(ladder([](double h) { return h; })), 0, 3);
  ASSERT_EQ(rough.rate_errors.size(), 3u);
  for (const double error : smooth.rate_errors) EXPECT_LT(error, 1e-12);
  // Logarithms within ln 1.2 have the deviation 0.053; the sixteen steps of two levels 0.40.
  for (const double error : rough.rate_errors) EXPECT_NEAR(error, 0.053 / (4 * 0.40), 0.015);
}

}  // namespace
}  // namespace clackers::judge
