#include "paper/figures/curves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clackers::paper {
namespace {

using std::numbers::pi;

TEST(Curve, VelocityHasTwoPointsAndDisplacementOneAtAnImpact) {
  const auto test_case = cases::make("two-parameter", {{"N", 1.0}});
  const double t1 = test_case.motion->impact(1).t;
  const auto v = curve(test_case, 2, Quantity::velocity),
             u = curve(test_case, 2, Quantity::displacement);
  EXPECT_EQ(std::ranges::count(v.x, t1), 2);
  EXPECT_EQ(std::ranges::count(u.x, t1), 1);
  const auto at = std::size_t(std::ranges::find(v.x, t1) - v.x.begin());
  EXPECT_DOUBLE_EQ(v.y[at], test_case.motion->impact(1).before.v[1]);
  EXPECT_DOUBLE_EQ(v.y[at + 1], test_case.motion->impact(1).after.v[1]);
  EXPECT_EQ(u.y[std::size_t(std::ranges::find(u.x, t1) - u.x.begin())], 0.0);
}

TEST(Curve, EveryExtremumOfTheUndampedMotionIsAPoint) {
  const auto test_case = cases::make("two-parameter", {{"N", 2.0}, {"xi1", 0.0}});
  const auto u = curve(test_case, 2, Quantity::displacement);
  EXPECT_TRUE(std::ranges::is_sorted(u.x));
  int extrema = 0;
  for (const double y : u.y) extrema += std::abs(std::abs(y) - 1.0 / 3.0) < 1e-14;
  // |cos 9t| = 1 at t = m pi/9, m = 0 ... 57 in 20 s
  EXPECT_EQ(extrema, 58);
}

TEST(Curve, LastPointIsTheEndOfTheRun) {
  for (const auto* name : {"sdof", "stop", "three-parameter"}) {
    const auto test_case = cases::make(name);
    const auto u = curve(test_case, 1, Quantity::displacement, 10);
    EXPECT_EQ(u.x.front(), 0.0);
    EXPECT_EQ(u.x.back(), 20.0);
    for (std::size_t i = 1; i < u.x.size(); ++i)
      EXPECT_LT(u.x[i] - u.x[i - 1], 0.1001 * pi * 1.002);
  }
}

TEST(Panel, ResponseHasACurveForEachMassAndTheRunAsRange) {
  const auto one = response_panel(cases::make("stop"), Quantity::velocity, "a", "note");
  EXPECT_EQ(one.series.size(), 1u);
  EXPECT_EQ(one.series[0].name, "the mass");
  EXPECT_EQ(one.y.title, "velocity v [m/s]");
  const auto two = response_panel(cases::make("three-parameter", {{"a_t", 2.0}}),
                                  Quantity::displacement, "b", "");
  ASSERT_EQ(two.series.size(), 2u);
  EXPECT_EQ(two.series[1].name, "mass 2");
  EXPECT_EQ(two.x.highest, 40.0);
}

TEST(WithoutContact, EqualsTheCollidingMassUntilTheFirstImpactOnly) {
  const auto test_case = cases::make("two-parameter", {{"N", 1.0}});
  const auto with = curve(test_case, 2, Quantity::displacement);
  const auto alone = without_contact(test_case, 2, with);
  const double t1 = test_case.motion->impact(1).t;
  for (std::size_t i = 0; with.x[i] < 3.0 * t1; ++i)
    EXPECT_NEAR(alone.y[i], with.x[i] < t1 ? with.y[i] : -with.y[i], 1e-14);
}

TEST(Constants, UnknownNameIsRefused) {
  const auto test_case = cases::make("three-parameter");
  EXPECT_EQ(constant(test_case, "X"), 9.0);
  EXPECT_EQ(constant(test_case, "I_ms"), 9.0);
  EXPECT_THROW(constant(test_case, "Y"), std::logic_error);
}

}  // namespace
}  // namespace clackers::paper
