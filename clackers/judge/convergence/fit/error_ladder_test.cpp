#include "clackers/judge/convergence/fit/error_ladder.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::judge {
namespace {

LevelView view_one(const ErrorLevel& level) { return view(std::span(&level, 1)).front(); }

TEST(ErrorLadder, PointsAreSortedFromCoarseToFineOnLogarithmicAxes) {
  const auto seen = view_one({{1.0, 3.0, 0.0}, {2.0, 1.0, 0.0}, {0.5, 2.0, 0.0}});
  EXPECT_EQ(seen.x, (std::vector{std::log(2.0), 0.0, std::log(0.5)}));
  EXPECT_EQ(seen.y, (std::vector{0.0, std::log(3.0), std::log(2.0)}));
  EXPECT_EQ(seen.step, 1.0);
  EXPECT_EQ(seen.error, 3.0);
}

TEST(ErrorLadder, FailuresAndZerosHaveNoPointButOnlyFailuresCount) {
  const auto seen =
      view_one({{4.0, NAN, 0.0}, {2.0, 0.0, 0.0}, {1.0, 3.0, 0.0}, {0.5, INFINITY, 0.0}});
  EXPECT_EQ(seen.x.size(), 1u);
  EXPECT_TRUE(seen.usable);
  const auto failed = view_one({{4.0, NAN, 0.0}, {2.0, NAN, 0.0}, {1.0, 3.0, 0.0}});
  EXPECT_FALSE(failed.usable);
  EXPECT_EQ(failed.step, 1.0);
  EXPECT_TRUE(std::isnan(failed.error));
  EXPECT_FALSE(view_one({}).usable);
  EXPECT_FALSE(view_one({{4.0, NAN, 0.0}}).at_floor);
}

TEST(ErrorLadder, TheFloorIsReachedWithinItsSlack) {
  const ErrorLevel mixed{{8.0, 9.9, 1.0}, {4.0, 10.1, 1.0}, {2.0, 50.0, 1.0}, {1.0, 60.0, 1.0}};
  EXPECT_FALSE(view_one(mixed).at_floor);
  EXPECT_TRUE(view_one(mixed).near_floor);
  EXPECT_TRUE(view_one({{8.0, 9.9, 1.0}, {4.0, 10.0, 1.0}, {1.0, NAN, 1.0}}).at_floor);
  const ErrorLevel one_in_five{
      {8.0, 9.9, 1.0}, {4.0, 11.0, 1.0}, {2.0, 50.0, 1.0}, {1.0, 60.0, 1.0}, {0.5, 70.0, 1.0}};
  EXPECT_FALSE(view_one(one_in_five).near_floor);
  EXPECT_TRUE(view_one({{1.0, 0.0, 0.0}}).at_floor);
}

TEST(ErrorLadder, RefusesWhatCannotBe) {
  EXPECT_THROW(view_one({{0.0, 1.0, 0.0}}), InputError);
  EXPECT_THROW(view_one({{NAN, 1.0, 0.0}}), InputError);
  EXPECT_THROW(view_one({{1.0, -1.0, 0.0}}), InputError);
  EXPECT_THROW(view_one({{1.0, 1.0, -1.0}}), InputError);
  EXPECT_THROW(view_one({{1.0, 1.0, NAN}}), InputError);
}

}  // namespace
}  // namespace clackers::judge
