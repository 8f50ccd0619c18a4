#include "clackers/methods/stepping/step_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/testing/refusal.hpp"

namespace clackers::methods {
namespace {

TEST(StepPlan, EndsOnTheEndToTheBitForWholeNumbersOfSteps) {
  for (const long long n : {1LL, 3LL, 7LL, 400LL, 12345LL, 999999937LL})
    for (const double end : {20.0, 0.3, 1.0 / 3, 1e9}) {
      const auto plan = plan_steps("who", 0.0, end, end / double(n));
      EXPECT_EQ(plan.whole, n) << end;
      EXPECT_EQ(plan.total, n) << end;
      EXPECT_EQ(plan.time(n), end);
    }
  EXPECT_EQ(plan_steps("who", 0.0, 20.0, 0.05).total, 400);  // a decimal fraction
  EXPECT_EQ(plan_steps("who", 0.1, 20.3, 0.1).total, 202);   // three of them
}

TEST(StepPlan, CountsTimes) {
  const auto plan = plan_steps("who", 1.0, 11.0, 0.1);
  EXPECT_EQ(plan.time(0), 1.0);
  EXPECT_EQ(plan.time(37), 1.0 + 37 * 0.1);
}

TEST(StepPlan, EndsWithAShorterStepWhereStepsDoNotFit) {
  const auto plan = plan_steps("who", 0.0, 1.0, 0.3);
  EXPECT_EQ(plan.whole, 3);
  EXPECT_EQ(plan.total, 4);
  EXPECT_EQ(plan.time(3), 3 * 0.3);
  EXPECT_EQ(plan.time(4), 1.0);
  // A thousandth of a step is no rounding.
  EXPECT_EQ(plan_steps("who", 0.0, 1.0001, 0.1).total, 11);
  EXPECT_EQ(plan_steps("who", 0.0, 0.9999, 0.1).whole, 9);
}

TEST(StepPlan, RefusesWhatCannotRun) {
  for (const double h : {0.0, -1.0})
    EXPECT_REFUSED(plan_steps("who", 0, 20, h), "step-not-positive");
  EXPECT_REFUSED(plan_steps("who", 0, 20, NAN), "not-a-number");
  EXPECT_REFUSED(plan_steps("who", 0, 20, INFINITY), "not-finite");
  EXPECT_REFUSED(plan_steps("rk4+event-driven", 0, 20, 30), "out-of-range",
                 "rk4+event-driven: h = 30; allowed: h <= 20, the length of the run in seconds. "
                 "Use a step that is not longer than the run.");
  EXPECT_NO_THROW(plan_steps("who", 0, 20, 20.0));
  EXPECT_REFUSED(plan_steps("who", 0, 20, 1.9e-8), "too-many-steps");
  EXPECT_REFUSED(plan_steps("who", 0, 20, 5e-324), "too-many-steps");
  // 1e-7 is lost in the rounding of 1e9.
  EXPECT_REFUSED(plan_steps("who", 1e9, 1e9 + 1e-4, 1e-7), "out-of-range", "nearer to time 0");
  EXPECT_NO_THROW(plan_steps("who", 1e9, 1e9 + 1, 1e-2));
}

TEST(StepPlan, OfAToleranceHasNoStep) {
  const auto plan = plan_adaptive("dopri5", 1.0, 20.0, 1e-6);
  EXPECT_TRUE(plan.is_adaptive());
  EXPECT_FALSE(plan_steps("who", 0.0, 1.0, 0.1).is_adaptive());
  EXPECT_EQ(plan.end, 20.0);
  EXPECT_EQ(plan.tolerance, 1e-6);
  EXPECT_REFUSED(plan_adaptive("dopri5", 0, 1, 1e-14), "tolerance-too-small",
                 "dopri5: tolerance = 1e-14; allowed: tolerance >= 2.2e-14.");
  EXPECT_NO_THROW(plan_adaptive("dopri5", 0, 1, least_tolerance));
  for (const double tolerance : {0.0, -1.0, 1.0})
    EXPECT_REFUSED(plan_adaptive("dopri5", 0, 1, tolerance), "out-of-range");
}

}  // namespace
}  // namespace clackers::methods
