#include "clackers/assess/convergence/fit/window.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/assess/testing/synthetic_ladder.hpp"

namespace clackers::assess {
namespace {

using namespace synthetic;

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
  EXPECT_NEAR(drift(by_rates({1.6, 1.5, 1.3}, 1.45, 0.0)), 0.15, 1e-12);
  EXPECT_NEAR(drift(by_rates({1.3, 1.5, 1.6}, 1.45, 0.0)), 0.15, 1e-12);
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
}  // namespace clackers::assess
