#include "clackers/tables/times/time_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/testing/refusal.hpp"

namespace clackers::tables {
namespace {

TEST(TimeGrid, OfSamplesIncludesBothEndsExactly) {
  // 0.1 = end / 49 * 49 misses the end by rounding for about a third of these.
  for (const double end : {20.0, 0.1, 1.0 / 3.0, 7.7, 1e9})
    for (long long n = 2; n < 200; ++n) {
      const auto grid = grid_of(n, end);
      ASSERT_EQ(grid.size(), n);
      EXPECT_EQ(grid.at(0), 0.0);
      EXPECT_EQ(grid.at(n - 1), end);
      // Half a unit from the division and half a unit from the product.
      EXPECT_NEAR(grid.at(n / 2), double(n / 2) * end / double(n - 1), 2.3e-16 * end);
    }
}

TEST(TimeGrid, OfSamplesStaysInsideTheRun) {
  for (long long n = 2; n < 2000; ++n) {
    const auto grid = grid_of(n, 0.1);
    for (long long k = 1; k < n; ++k) ASSERT_GT(grid.at(k), grid.at(k - 1)) << n;
  }
}

TEST(TimeGrid, RefusesFewerThanTwoSamplesInWords) {
  for (const long long n : {1LL, 0LL, -5LL}) EXPECT_REFUSED(grid_of(n, 20.0), "out-of-range");
  EXPECT_REFUSED(grid_of(1, 20.0), "out-of-range",
                 "respond: samples = 1; allowed: a whole number, 2 <= samples <= 1e9. Both ends of "
                 "the run are among them.");
}

TEST(TimeGrid, RefusesMoreThanABillionRows) {
  EXPECT_REFUSED(grid_of(1'000'000'001, 20.0), "too-many-rows");
  EXPECT_EQ(grid_of(1'000'000'000, 20.0).size(), 1'000'000'000);
  EXPECT_REFUSED(grid_every(1e-9, 20.0), "too-many-rows");
}

TEST(TimeGrid, OfAStepReachesAnEndThatOnlyRoundingHides) {
  // 3 * 0.1 > 0.3, and 0.7 / 0.1 < 7 in binary64.
  for (const auto& [step, end, count] : {std::tuple{0.1, 0.3, 4},
                                         {0.1, 0.7, 8},
                                         {0.01, 20.0, 2001},
                                         {0.3, 20.0, 67},
                                         {20.0, 20.0, 2}}) {
    const auto grid = grid_every(step, end);
    ASSERT_EQ(grid.size(), count) << step << " " << end;
    EXPECT_LE(grid.at(count - 1), end);
    EXPECT_EQ(grid.at(1), step);
  }
  EXPECT_EQ(grid_every(0.1, 0.3).at(3), 0.3);
  EXPECT_EQ(grid_every(0.3, 20.0).at(66), 66 * 0.3);
}

TEST(TimeGrid, RefusesStepsThatAreNotPositiveOrLongerThanTheRun) {
  EXPECT_REFUSED(grid_every(0.0, 20.0), "step-not-positive");
  EXPECT_REFUSED(grid_every(-0.1, 20.0), "step-not-positive");
  EXPECT_REFUSED(grid_every(20.1, 20.0), "out-of-range");
  EXPECT_REFUSED(grid_every(NAN, 20.0), "not-a-number");
  EXPECT_REFUSED(grid_every(INFINITY, 20.0), "not-finite");
}

TEST(TimeGrid, LatestIsThatOfTimesInAnyOrder) {
  EXPECT_EQ((TimeGrid{0.0, 0, 0.0, {1.0, 3.0, 2.0}}).latest(), 3.0);
  EXPECT_EQ(grid_of(4, 0.7).latest(), 0.7);
  EXPECT_EQ(grid_every(0.3, 1.0).latest(), 3.0 * 0.3);
  EXPECT_EQ(TimeGrid{}.latest(), 0.0);
}

}  // namespace
}  // namespace clackers::tables
