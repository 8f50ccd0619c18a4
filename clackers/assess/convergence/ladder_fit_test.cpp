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

// A ladder of one step a level whose rates between levels are given, coarse to fine.
std::vector<ErrorLevel> by_rates(const std::vector<double>& rates, double first = 0.1) {
  std::vector<ErrorLevel> made{{{0.05, first, 0.0}}};
  for (const double rate : rates) {
    const auto before = made.back().front();
    made.push_back({{0.5 * before.step, before.error * std::exp2(-rate), 0.0}});
  }
  return made;
}

TEST(LadderFit, RatesAroundTheClaimThatDoNotSettleOnItLeaveUndecided) {
  // The slope is within a tenth of 2, a rate is not: neither proper nor reduced.
  EXPECT_BEHAVIOUR(fit_ladder(by_rates({1.75, 1.95, 1.93}), {.claimed_order = 2.0}),
                   Behaviour::undecided, "too-few-levels");
  // The slope is below, the finest rate already within.
  EXPECT_BEHAVIOUR(fit_ladder(by_rates({1.7, 1.66, 1.83}), {.claimed_order = 2.0}),
                   Behaviour::undecided, "too-few-levels");
}

TEST(LadderFit, OneRateThatMovesIsNoTrend) {
  for (const auto& rates : {std::vector{1.5, 1.5, 1.56}, {1.5, 1.56, 1.56}, {1.56, 1.53, 1.5}})
    EXPECT_BEHAVIOUR(fit_ladder(by_rates(rates), {.claimed_order = 2.0}), Behaviour::reduced, "");
  EXPECT_BEHAVIOUR(fit_ladder(by_rates({1.5, 1.56, 1.62}), {.claimed_order = 2.0}),
                   Behaviour::undecided, "no-convergence-yet");
}

TEST(LadderFit, GrowthThatSlowsDownALittleIsStillDivergent) {
  EXPECT_BEHAVIOUR(fit_ladder(by_rates({-1.1, -1.05, -1.0}, 1e-4), {.claimed_order = 2.0}),
                   Behaviour::divergent, "error-growth");
}

TEST(LadderFit, APureLineIsProperWithItsOrderAndConstant) {
  for (const double q : {1.0, 2.0, 4.0}) {
    const auto fit = fit_ladder(ladder([&](double h) { return 3.0 * pow(h, q); }, {.levels = 6}),
                                {.claimed_order = q});
    EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
    EXPECT_TRUE(fit.has_line);
    EXPECT_FALSE(fit.on_envelope);
    EXPECT_NEAR(fit.order, q, 1e-12);
    EXPECT_NEAR(fit.constant, 3.0, 1e-10);
    EXPECT_LT(fit.spread, 1e-12);
    EXPECT_NEAR(fit.scatter, 1.0, 1e-12);
    EXPECT_EQ(fit.first_level, 0);
    EXPECT_EQ(fit.last_level, 5);
  }
}

TEST(LadderFit, WithoutAClaimALineIsProperWithWhateverOrderItHas) {
  const auto fit = fit_ladder(ladder([](double h) { return pow(h, 1.37); }), {});
  EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
  EXPECT_NEAR(fit.order, 1.37, 1e-12);
}

TEST(LadderFit, SaturatedCoarseLevelsStayOutsideTheWindow) {
  const auto fit = fit_ladder(ladder([](double h) { return 1.9 * std::tanh(500.0 * h * h); }),
                              {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
  EXPECT_NEAR(fit.order, 2.0, 0.03) << told(fit);
  EXPECT_GE(fit.first_level, 1);
  EXPECT_EQ(fit.last_level, 7);
}

TEST(LadderFit, AHigherTermOnCoarseLevelsStaysOutsideTheWindow) {
  const auto fit =
      fit_ladder(ladder([](double h) { return h * h + 3e3 * pow(h, 4); }), {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
  EXPECT_NEAR(fit.order, 2.0, 0.05) << told(fit);
  EXPECT_GE(fit.first_level, 1);
}

TEST(LadderFit, ThreeLevelsAreTooFewAndFourAreEnough) {
  const auto square = [](double h) { return h * h; };
  EXPECT_BEHAVIOUR(fit_ladder(ladder(square, {.levels = 3}), {.claimed_order = 2.0}),
                   Behaviour::undecided, "too-few-levels");
  EXPECT_BEHAVIOUR(fit_ladder(ladder(square, {.levels = 4}), {.claimed_order = 2.0}),
                   Behaviour::proper, "");
}

TEST(LadderFit, AnOrderAFewPercentOffIsProperAndOneFurtherOffIsReduced) {
  for (const double order : {1.83, 1.95, 2.17}) {
    const auto fit =
        fit_ladder(ladder([&](double h) { return pow(h, order); }), {.claimed_order = 2.0});
    EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
    EXPECT_NEAR(fit.order, order, 1e-9);
  }
  for (const double order : {1.0, 1.5, 1.75}) {
    const auto fit =
        fit_ladder(ladder([&](double h) { return pow(h, order); }), {.claimed_order = 2.0});
    EXPECT_BEHAVIOUR(fit, Behaviour::reduced, "");
    EXPECT_NEAR(fit.order, order, 1e-9);
  }
}

TEST(LadderFit, ASteeperLineThanClaimedIsProperWithTheOrderItHas) {
  const auto fit =
      fit_ladder(ladder([](double h) { return pow(h, 4); }, {.levels = 6}), {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
  EXPECT_NEAR(fit.order, 4.0, 1e-9);
}

TEST(LadderFit, OfTwoRegimesTheFineOneDecides) {
  const auto fit =
      fit_ladder(ladder([](double h) { return 100.0 * h * h + h; }), {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::reduced, "");
  EXPECT_NEAR(fit.order, 1.0, 0.1) << told(fit);
  EXPECT_GE(fit.first_level, 2);
}

TEST(LadderFit, RatesThatStillMoveTowardsTheClaimLeaveUndecided) {
  const auto from_below = [](double h) { return pow(h, 2) / (1.0 + pow(h / 0.0008, 0.7)); };
  EXPECT_BEHAVIOUR(fit_ladder(ladder(from_below), {.claimed_order = 2.0}), Behaviour::undecided,
                   "no-convergence-yet");
  const auto from_above = [](double h) { return pow(h, 2) * (1.0 + pow(h / 0.0008, 0.7)); };
  EXPECT_BEHAVIOUR(fit_ladder(ladder(from_above), {.claimed_order = 2.0}), Behaviour::undecided,
                   "no-convergence-yet");
}

TEST(LadderFit, ABendBeforeThreeProperLevelsLeavesTooFew) {
  const auto made = ladder([](double h) { return 2.0 * std::tanh(3e5 * h * h); });
  EXPECT_BEHAVIOUR(fit_ladder(made, {.claimed_order = 2.0}), Behaviour::undecided,
                   "too-few-levels");
}

TEST(LadderFit, OneStepALevelCarriesALineAndAPlateau) {
  const Shape single{.neighbours = 1};
  EXPECT_BEHAVIOUR(
      fit_ladder(ladder([](double h) { return h * h; }, single), {.claimed_order = 2.0}),
      Behaviour::proper, "");
  EXPECT_BEHAVIOUR(
      fit_ladder(ladder([](double h) { return h * h + 1e-4; }, single), {.claimed_order = 2.0}),
      Behaviour::stagnating, "unexplained-floor");
}

TEST(LadderFit, TheAnswerDoesNotDependOnTheUnitOfTime) {
  for (const double unit : {1e-6, 1e6}) {
    const auto scaled = [&](double h) { return pow(h / unit, 2); };
    const auto fit = fit_ladder(ladder(scaled, {.coarsest = 0.05 * unit, .end = 20.0 * unit}),
                                {.claimed_order = 2.0});
    EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
    EXPECT_NEAR(fit.order, 2.0, 1e-9);
  }
}

}  // namespace
}  // namespace clackers::assess
