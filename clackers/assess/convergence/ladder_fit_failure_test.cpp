#include <gtest/gtest.h>

#include <cmath>

#include "clackers/assess/convergence/ladder_fit.hpp"
#include "clackers/assess/testing/expect_behaviour.hpp"
#include "clackers/assess/testing/synthetic_ladder.hpp"
#include "clackers/base/error.hpp"

namespace clackers::assess {
namespace {

using namespace synthetic;
using std::pow;

TEST(LadderFit, TheRoundingFloorEndsTheWindow) {
  Scatter rounding(3.0, 1);
  const auto fit =
      fit_ladder(ladder([&](double h) { return 30.0 * pow(h, 4) + rounding() * 4e-16 * 20.0 / h; }),
                 {.claimed_order = 4.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
  EXPECT_NEAR(fit.order, 4.0, 0.05) << told(fit);
  EXPECT_GE(fit.last_level, 4);
  EXPECT_LE(fit.last_level, 6);
  EXPECT_GT(fit.floor, 1e-12);
  EXPECT_LT(fit.floor, 3e-10);
}

TEST(LadderFit, AFloorAfterThreeLevelsLeavesTooFew) {
  Scatter rounding(3.0, 2);
  const auto fit =
      fit_ladder(ladder([&](double h) { return 1e-2 * pow(h, 4) + rounding() * 4e-16 * 20.0 / h; }),
                 {.claimed_order = 4.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::undecided, "too-few-levels");
}

TEST(LadderFit, ALineThroughTheEstimatedFloorIsFollowedToItsEnd) {
  const auto fit =
      fit_ladder(ladder([](double h) { return 2.7e3 * pow(h, 4); }), {.claimed_order = 4.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
  EXPECT_EQ(fit.last_level, 7);
}

TEST(LadderFit, LevelsBentByRoundingAreLeftOutWhereTheFloorIsSeenAndFollowsThem) {
  const auto bent = [](int levels) {
    return ladder([](double h) { return 1e-5 * h * h + 6.0 * 2.2e-16 * 20.0 / h; },
                  {.levels = levels});
  };
  const auto fit = fit_ladder(bent(8), {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
  EXPECT_EQ(fit.last_level, 3);
  // Without a level at the floor nothing shows that it is rounding which bends the line.
  EXPECT_EQ(fit_ladder(bent(5), {.claimed_order = 2.0}).behaviour, Behaviour::undecided);
}

TEST(LadderFit, ThreeLevelsBentByRoundingAreTooManyToLeaveOut) {
  std::vector<ErrorLevel> made;
  double h = 0.1;
  for (const double floors : {4000.0, 2000.0, 1000.0, 500.0, 90.0, 60.0, 30.0, 5.0})
    made.push_back({{h /= 2.0, 1e-6 * floors, 1e-6}});
  EXPECT_BEHAVIOUR(fit_ladder(made, {.claimed_order = 1.0}), Behaviour::undecided,
                   "too-few-levels");
  made.erase(made.begin() + 6);
  EXPECT_BEHAVIOUR(fit_ladder(made, {.claimed_order = 1.0}), Behaviour::proper, "");
}

TEST(LadderFit, GrowthUntilRunsFailIsDivergent) {
  const auto fit = fit_ladder(ladder([](double h) { return h < 0.0008 ? nan : 1e-6 / (h * h); }),
                              {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::divergent, "error-growth");
}

TEST(LadderFit, FailedRunsOnCoarseLevelsDoNotPoisonTheRest) {
  for (const double bad : {nan, HUGE_VAL, 1e218}) {
    SCOPED_TRACE(bad);
    const auto fit = fit_ladder(ladder([&](double h) { return h > 0.0126 ? bad : h * h; }),
                                {.claimed_order = 2.0});
    EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
    EXPECT_EQ(fit.first_level, 2);
    EXPECT_NEAR(fit.order, 2.0, 1e-9);
  }
}

TEST(LadderFit, AFailedLevelInTheMiddleCutsTheWindow) {
  auto made = ladder([](double h) { return h * h; });
  for (auto& point : made[3]) point.error = nan;
  const auto fit = fit_ladder(made, {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
  EXPECT_EQ(fit.first_level, 4);
  EXPECT_TRUE(std::isnan(fit.errors[3]));
  for (auto& point : made[4]) point.error = nan;
  EXPECT_BEHAVIOUR(fit_ladder(made, {.claimed_order = 2.0}), Behaviour::undecided,
                   "too-few-levels");
}

TEST(LadderFit, SingleFailedRunsAreLeftOut) {
  auto made = ladder([](double h) { return h * h; });
  for (std::size_t i = 0; i < made.size(); ++i) made[i][(3 * i) % 8].error = nan;
  const auto fit = fit_ladder(made, {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
  EXPECT_EQ(fit.first_level, 0);
  EXPECT_EQ(fit.last_level, 7);
}

TEST(LadderFit, AFailedFinestLevelIsNotPassedOver) {
  auto made = ladder([](double h) { return h * h; });
  for (std::size_t j = 0; j < 5; ++j) made.back()[j].error = nan;
  EXPECT_BEHAVIOUR(fit_ladder(made, {.claimed_order = 2.0}), Behaviour::undecided, "run-failed");
  made.back()[0].error = 1e-7;
  EXPECT_EQ(fit_ladder(made, {}).behaviour, Behaviour::proper);
}

TEST(LadderFit, NothingButFailuresIsUndecided) {
  EXPECT_BEHAVIOUR(fit_ladder(ladder([](double) { return nan; }), {.claimed_order = 2.0}),
                   Behaviour::undecided, "run-failed");
  EXPECT_BEHAVIOUR(fit_ladder({}, {.claimed_order = 2.0}), Behaviour::undecided, "too-few-levels");
}

TEST(LadderFit, ErrorsAtTheRoundingFloorEverywhereAreExact) {
  EXPECT_BEHAVIOUR(fit_ladder(ladder([](double) { return 0.0; }), {}), Behaviour::exact, "");
  Scatter rounding(20.0, 11);
  const auto fit =
      fit_ladder(ladder([&](double h) { return 2e-16 / h * rounding(); }), {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::exact, "");
  EXPECT_GT(fit.floor, 0.0);
  // Exact at fine steps alone, after coarse ones that failed, is not exact at every level.
  const auto partly = fit_ladder(ladder([](double h) { return h > 0.02 ? nan : 0.0; }), {});
  EXPECT_BEHAVIOUR(partly, Behaviour::undecided, "run-failed");
}

TEST(LadderFit, RefusesErrorsAndStepsThatCannotBe) {
  EXPECT_THROW(fit_ladder(std::vector<ErrorLevel>{{{0.1, -1.0, 0.0}}}, {}), InputError);
  EXPECT_THROW(fit_ladder(std::vector<ErrorLevel>{{{0.0, 1.0, 0.0}}}, {}), InputError);
  EXPECT_THROW(fit_ladder(std::vector<ErrorLevel>{{{0.1, 1.0, nan}}}, {}), InputError);
}

}  // namespace
}  // namespace clackers::assess
