#include "clackers/tables/times/timed_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/tables/testing/counted_motion.hpp"

namespace clackers::tables {
namespace {

TEST(ImpactFinder, FindsExactlyTheDoublesOfTheImpactsInAnyOrder) {
  for (const bool late : {false, true}) {
    const CountedMotion motion(1, 10.0, {1.0, 2.5, 2.75, 10.0}, late);
    ImpactFinder finder(motion);
    for (const double t : {2.75, 0.0, 1.0, 1.0, 10.0, 2.5, 5.0, 1.0, 9.0, 2.6, 2.5}) {
      const bool expected = t == 1.0 || t == 2.5 || t == 2.75 || t == 10.0;
      EXPECT_EQ(finder.is_impact(t), expected) << t << " late " << late;
      EXPECT_FALSE(finder.is_impact(std::nextafter(t, 5.1))) << t;
    }
  }
}

TEST(ImpactFinder, KnowsAMotionWithoutImpacts) {
  const CountedMotion motion(1, 10.0, {});
  ImpactFinder finder(motion);
  for (const double t : {0.0, 3.0, 10.0}) EXPECT_FALSE(finder.is_impact(t));
}

TEST(ImpactFinder, AsksForEachImpactAFewTimesOnAnAscendingWalk) {
  const CountedMotion motion(1, 10.0, {1.0, 2.5, 2.75});
  ImpactFinder finder(motion);
  for (int k = 0; k <= 10000; ++k) finder.is_impact(10.0 * k / 10000.0);
  // Twice for each segment entered, at most twice more at its border.
  EXPECT_LE(motion.asked(), 16);
}

}  // namespace
}  // namespace clackers::tables
