#include "clackers/judge/convergence/self_convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/judge/testing/expect_behaviour.hpp"
#include "clackers/judge/testing/synthetic_ladder.hpp"
#include "clackers/judge/testing/synthetic_runs.hpp"

namespace clackers::judge {
namespace {

using namespace synthetic;
using std::pow;
using Values = std::vector<double>;

TEST(SelfConvergence, ThePseudoErrorOfAPowerIsTheErrorOfTheFinerRun) {
  for (const double q : {1.0, 2.0, 4.0}) {
    const auto made = runs([&](double h) { return Values{5.0 + 3.0 * pow(h, q)}; }, 6, 4);
    const auto self = self_convergence(made, {.claimed_order = q, .size = 10.0});
    EXPECT_BEHAVIOUR(self.differences, Behaviour::proper, "");
    EXPECT_TRUE(self.proper);
    EXPECT_NEAR(self.differences.order, q, 1e-6);
    ASSERT_EQ(self.differences.steps.size(), 5u);
    for (std::size_t j = 0; j < 5; ++j) {
      EXPECT_EQ(self.differences.steps[j], made[j + 1].front().step);
      EXPECT_NEAR(self.differences.errors[j], 0.3 * pow(made[j + 1].front().step, q), 1e-14);
    }
    EXPECT_EQ(self.estimate, self.differences.errors[4]);
  }
}

TEST(SelfConvergence, UnevenRatiosOfStepsAreTakenAsTheyAre) {
  std::vector<ResponseLevel> made;
  for (const double h : {0.1, 0.07, 0.03, 0.02, 0.008, 0.003})
    made.push_back({{h, {1.0 - 2.0 * h * h}, 0.0}});
  const auto self = self_convergence(made, {.claimed_order = 2.0});
  EXPECT_TRUE(self.proper);
  EXPECT_NEAR(self.differences.order, 2.0, 1e-9);
  EXPECT_NEAR(self.estimate, 2.0 * 0.003 * 0.003, 1e-12);
}

TEST(SelfConvergence, TheLargestDifferenceOfAllValuesCounts) {
  const auto made = runs([](double h) { return Values{h * h, -7.0 * h * h, 0.0}; });
  EXPECT_NEAR(self_convergence(made, {.claimed_order = 2.0}).differences.constant, 7.0, 1e-6);
}

TEST(SelfConvergence, WithoutAClaimTheDifferencesThemselvesAreFittedAndNothingIsProper) {
  const auto self = self_convergence(runs([](double h) { return Values{h * h}; }), {});
  EXPECT_NEAR(self.differences.order, 2.0, 1e-9);
  EXPECT_NEAR(self.differences.constant, 3.0, 1e-6);
  EXPECT_FALSE(self.proper);
}

TEST(SelfConvergence, AnotherOrderThanClaimedIsNotProper) {
  for (const double q : {1.0, 4.0}) {
    const auto self =
        self_convergence(runs([](double h) { return Values{h * h}; }), {.claimed_order = q});
    EXPECT_FALSE(self.proper) << q;
  }
}

TEST(SelfConvergence, FiveLevelsAreTheLeast) {
  const auto square = [](double h) { return Values{h * h}; };
  EXPECT_TRUE(self_convergence(runs(square, 5), {.claimed_order = 2.0}).proper);
  const auto four = self_convergence(runs(square, 4), {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(four.differences, Behaviour::undecided, "too-few-levels");
  EXPECT_TRUE(std::isnan(four.estimate));
  EXPECT_EQ(self_convergence({}, {.claimed_order = 2.0}).differences.reason, "too-few-levels");
}

TEST(SelfConvergence, TheFloorsOfBothRunsEndTheLine) {
  int level = 0;
  auto made = runs([&](double h) { return Values{h * h + (++level % 2 ? 1e-6 : -1e-6)}; }, 10);
  EXPECT_FALSE(self_convergence(made, {.claimed_order = 2.0}).proper);
  for (auto& runs : made) runs[0].floor = 1e-6;
  const auto self = self_convergence(made, {.claimed_order = 2.0});
  EXPECT_TRUE(self.proper);
  EXPECT_LT(self.differences.last_level, 7);
  EXPECT_GT(self.differences.floor, 2e-6 / 3.0);
  EXPECT_LT(self.differences.floor, rounding_slack * 2e-6 / 3.0);
  // Nothing above ten floors of both runs together: 2 / 3 of one of them each.
  for (auto& runs : made) runs[0].floor = 1.01 * 2.5e-3 / (10.0 * 2.0 / 3.0);
  const auto none = self_convergence(made, {.claimed_order = 2.0});
  EXPECT_EQ(none.differences.behaviour, Behaviour::exact);
  for (auto& runs : made) runs[0].floor *= 0.98;
  EXPECT_NE(self_convergence(made, {.claimed_order = 2.0}).differences.behaviour, Behaviour::exact);
}

TEST(SelfConvergence, AFailedRunLeavesTwoDifferencesOut) {
  for (const Values& bad : {Values{}, Values{nan}, Values{HUGE_VAL}}) {
    auto made = runs([](double h) { return Values{h * h}; }, 8);
    made[1][0].values = bad;
    const auto self = self_convergence(made, {.claimed_order = 2.0});
    EXPECT_TRUE(self.proper);
    EXPECT_EQ(self.differences.first_level, 2);
    made[7][0].values = bad;
    EXPECT_EQ(self_convergence(made, {.claimed_order = 2.0}).differences.reason, "run-failed");
  }
}

TEST(SelfConvergence, AContactThatNoStepResolvesIsSaidHereToo) {
  const auto self = self_convergence(runs([](double h) { return Values{h * h}; }),
                                     {.claimed_order = 2.0, .contact_time = 1e-3});
  EXPECT_EQ(self.differences.reason, "contact-not-resolved");
}

TEST(SelfConvergence, RefusesRunsThatCannotBeCompared) {
  const auto square = [](double h) { return Values{h * h}; };
  const SelfContext second{.claimed_order = 2.0};
  auto made = runs(square, 6, 2);
  made[2].pop_back();
  EXPECT_THROW(self_convergence(made, second), InputError);
  made = runs(square);
  made[2][0].values.push_back(1.0);
  EXPECT_THROW(self_convergence(made, second), InputError);
  made = runs(square);
  std::swap(made[2], made[3]);
  EXPECT_THROW(self_convergence(made, second), InputError);
  made = runs(square);
  made[2][0].floor = -1.0;
  EXPECT_THROW(self_convergence(made, second), InputError);
  made = runs(square);
  EXPECT_THROW(self_convergence(made, {.claimed_order = 2.0, .size = 0.0}), InputError);
  made[0][0].step *= 1.02;
  EXPECT_THROW(self_convergence(made, {}), InputError);
  EXPECT_NO_THROW(self_convergence(made, second));
  EXPECT_THROW(true_convergence(made, Values{0.0, 0.0}, second), InputError);
}

}  // namespace
}  // namespace clackers::judge
