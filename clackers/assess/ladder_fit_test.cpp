#include "clackers/assess/ladder_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "clackers/assess/synthetic_ladder.hpp"
#include "clackers/base/error.hpp"

namespace clackers::assess {
namespace {

using namespace synthetic;
using std::pow;

std::string told(const LadderFit& fit) {
  return std::string(to_string(fit.behaviour)) + " (" + fit.reason + ") order " +
         std::to_string(fit.order) + " +- " + std::to_string(fit.spread) + " scatter " +
         std::to_string(fit.scatter) + " levels " + std::to_string(fit.first_level) + ".." +
         std::to_string(fit.last_level);
}

#define EXPECT_BEHAVIOUR(fit, expected, why)         \
  EXPECT_EQ((fit).behaviour, expected) << told(fit); \
  EXPECT_EQ((fit).reason, why) << told(fit)

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

TEST(LadderFit, ScatterBetweenNeighboursIsIrregularWithTheOrderOfTheEnvelope) {
  double mean = 0.0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Scatter scatter(seed % 2 == 0 ? 10.0 : 30.0, seed);
    const auto fit =
        fit_ladder(ladder([&](double h) { return 2.0 * h / scatter(); }), {.claimed_order = 1.0});
    EXPECT_BEHAVIOUR(fit, Behaviour::irregular, "");
    EXPECT_TRUE(fit.has_line);
    EXPECT_TRUE(fit.on_envelope);
    // Four standard deviations of the slope, see envelope_order_tolerance.
    EXPECT_NEAR(fit.order, 1.0, 0.3) << told(fit);
    mean += fit.order / 200;
    EXPECT_GT(fit.scatter, 4.0) << told(fit);
    EXPECT_GT(fit.spread, 0.01);
  }
  EXPECT_NEAR(mean, 1.0, 4 * 0.075 / std::sqrt(200.0));
}

TEST(LadderFit, ImpactsNoticedLateAreIrregularOfOrderOne) {
  for (const double first : {0.7, 1.571, 2.2}) {
    const auto fit = fit_ladder(ladder([&](double h) { return 3.0 * late_impacts(h, 6, first); }),
                                {.claimed_order = 2.0});
    EXPECT_BEHAVIOUR(fit, Behaviour::irregular, "");
    EXPECT_NEAR(fit.order, 1.0, 0.25) << told(fit);
  }
}

TEST(LadderFit, ScatterByHalfTheErrorIsAlreadyIrregularAndByATenthIsALine) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Scatter wide(3.0, seed), narrow(1.2, seed);
    const auto rough =
        fit_ladder(ladder([&](double h) { return h * wide(); }), {.claimed_order = 1.0});
    EXPECT_BEHAVIOUR(rough, Behaviour::irregular, "");
    const auto line =
        fit_ladder(ladder([&](double h) { return h * h * narrow(); }), {.claimed_order = 2.0});
    EXPECT_BEHAVIOUR(line, Behaviour::proper, "");
  }
}

TEST(LadderFit, TheEnvelopeIsThatOfEachLevelWithItsOwnStep) {
  auto made = ladder([](double h) { return h; }, {.levels = 4});
  made[1][5].error = 7.0;
  const auto fit = fit_ladder(made, {});
  ASSERT_EQ(fit.steps.size(), 4u);
  EXPECT_EQ(fit.steps[1], made[1][5].step);
  EXPECT_EQ(fit.errors[1], 7.0);
  EXPECT_EQ(fit.steps[2], made[2][0].step);
  EXPECT_EQ(fit.errors[2], made[2][0].error);
}

TEST(LadderFit, AnErrorThatNeverShrinksStagnatesAtItsLevel) {
  const auto fit =
      fit_ladder(ladder([](double h) { return 0.3 + 0.1 * h; }), {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::stagnating, "unexplained-floor");
  EXPECT_FALSE(fit.has_line);
  EXPECT_NEAR(fit.floor, 0.3, 0.005);
}

TEST(LadderFit, AnErrorThatShrinksAndThenStaysStagnates) {
  const auto fit =
      fit_ladder(ladder([](double h) { return 5.0 * h * h + 1e-4; }), {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::stagnating, "unexplained-floor");
  EXPECT_NEAR(fit.floor, 1e-4, 1e-5);
  const auto stated = fit_ladder(ladder([](double h) { return 5.0 * h * h + 1e-4; }),
                                 {.claimed_order = 2.0, .states_tolerance = true});
  EXPECT_BEHAVIOUR(stated, Behaviour::stagnating, "tolerance-floor");
}

TEST(LadderFit, APlateauOfPrintedDigitsStagnatesAlthoughItIsRough) {
  Scatter digits(1.3, 5);
  const auto fit = fit_ladder(ladder([&](double h) { return 5.0 * h * h + 5e-5 * digits(); }),
                              {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::stagnating, "unexplained-floor");
}

TEST(LadderFit, APlateauBehindAChangeOfSignIsNeitherIrregularNorDivergent) {
  for (const double zero : {0.02, 0.013, 0.0101, 0.0081, 0.005, 0.003})
    for (const double q : {1.0, 2.0}) {
      SCOPED_TRACE(testing::Message() << "zero at " << zero << " order " << q);
      const auto fit =
          fit_ladder(ladder([&](double h) { return 1e-2 * std::abs(1.0 - pow(h / zero, q)); }),
                     {.claimed_order = q});
      // Behind a late zero fewer than three levels are flat.
      if (fit.behaviour == Behaviour::undecided && zero < 0.006) continue;
      EXPECT_BEHAVIOUR(fit, Behaviour::stagnating, "unexplained-floor");
      EXPECT_NEAR(fit.floor, 1e-2, 1e-3);
    }
}

TEST(LadderFit, AChangeOfSignAmongTheFinestLevelsLeavesUndecided) {
  for (const double zero : {0.0013, 0.0008, 0.0005, 0.0003}) {
    SCOPED_TRACE(testing::Message() << "zero at " << zero);
    const auto fit =
        fit_ladder(ladder([&](double h) { return 1e-2 * std::abs(1.0 - pow(h / zero, 2)); }),
                   {.claimed_order = 2.0});
    EXPECT_EQ(fit.behaviour, Behaviour::undecided) << told(fit);
  }
}

TEST(LadderFit, TwoFlatLevelsAloneAreNoPlateau) {
  const auto made = ladder([](double h) { return h > 0.00076 ? h * h : 0.00078 * 0.00078; });
  EXPECT_EQ(fit_ladder(made, {.claimed_order = 2.0}).behaviour, Behaviour::undecided);
}

TEST(LadderFit, ARoughFlatLadderStagnates) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Scatter scatter(3.0, seed);
    const auto fit =
        fit_ladder(ladder([&](double) { return 1e-3 * scatter(); }), {.claimed_order = 1.0});
    EXPECT_NE(fit.behaviour, Behaviour::irregular) << told(fit);
    EXPECT_NE(fit.behaviour, Behaviour::divergent) << told(fit);
  }
}

TEST(LadderFit, ErrorsAsLargeAsTheMotionDoNotConvergeYet) {
  const auto fit = fit_ladder(ladder([](double h) { return 1.9 + h; }), {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::undecided, "no-convergence-yet");
  Scatter scatter(1.4, 3);
  const auto rough =
      fit_ladder(ladder([&](double) { return 1.2 * scatter(); }), {.claimed_order = 1.0});
  EXPECT_BEHAVIOUR(rough, Behaviour::undecided, "no-convergence-yet");
}

TEST(LadderFit, ACompliantContactExplainsItsFloorHoweverLarge) {
  Scatter chaos(50.0, 4);
  const auto penalty = [&](double h) {
    return 1.7 * (1.0 + 40.0 * h) + (h > 0.01 ? chaos() : 0.0);
  };
  const auto fit = fit_ladder(ladder(penalty), {.contact_time = 0.0157});
  EXPECT_BEHAVIOUR(fit, Behaviour::stagnating, "contact-stiffness");
  EXPECT_NEAR(fit.floor, 1.75, 0.1);
}

TEST(LadderFit, AContactThatNoStepResolvesIsUndecidedWhateverTheErrors) {
  const auto made = ladder([](double h) { return h * h; });
  const double finest = made.back().back().step;
  EXPECT_BEHAVIOUR(fit_ladder(made, {.claimed_order = 2.0, .contact_time = 24.9 * finest}),
                   Behaviour::undecided, "contact-not-resolved");
  EXPECT_EQ(fit_ladder(made, {.claimed_order = 2.0, .contact_time = 25.1 * finest}).behaviour,
            Behaviour::proper);
}

TEST(LadderFit, GrowthIsDivergentAndKeepsItsSign) {
  const auto fit = fit_ladder(ladder([](double h) { return 1e-6 / h; }), {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::divergent, "error-growth");
  EXPECT_NEAR(fit.order, -1.0, 1e-12);
  Scatter scatter(5.0, 7);
  const auto rough =
      fit_ladder(ladder([&](double h) { return 1e-6 / h * scatter(); }), {.claimed_order = 1.0});
  EXPECT_BEHAVIOUR(rough, Behaviour::divergent, "error-growth");
}

TEST(LadderFit, GrowthThatAcceleratesIsDivergent) {
  const auto fit = fit_ladder(ladder([](double h) { return 1e-9 * std::exp(pow(0.005 / h, 1.2)); }),
                              {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::divergent, "error-growth");
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

TEST(LadderFit, ThreeLevelsAreTooFewAndFourAreEnough) {
  const auto square = [](double h) { return h * h; };
  EXPECT_BEHAVIOUR(fit_ladder(ladder(square, {.levels = 3}), {.claimed_order = 2.0}),
                   Behaviour::undecided, "too-few-levels");
  EXPECT_BEHAVIOUR(fit_ladder(ladder(square, {.levels = 4}), {.claimed_order = 2.0}),
                   Behaviour::proper, "");
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

TEST(LadderFit, OneLuckyErrorOnALineDoesNotMatter) {
  for (const double luck : {0.0, 1e-13, 1e-8}) {
    auto made = ladder([](double h) { return h * h; });
    made[4][2].error = luck;
    const auto fit = fit_ladder(made, {.claimed_order = 2.0});
    EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
    EXPECT_NEAR(fit.order, 2.0, 0.1) << told(fit);
  }
}

TEST(LadderFit, OneErrorFarAboveALineDoesMatter) {
  auto made = ladder([](double h) { return h * h; });
  made[6][4].error *= 3.0;
  const auto fit = fit_ladder(made, {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::irregular, "");
  EXPECT_GT(fit.scatter, 2.0);
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

TEST(LadderFit, WithOneStepALevelAChangeOfSignIsNotIrregular) {
  for (const double zero : {0.02, 0.01, 0.006}) {
    const auto fit =
        fit_ladder(ladder([&](double h) { return 1e-2 * std::abs(1.0 - pow(h / zero, 2)); },
                          {.neighbours = 1}),
                   {.claimed_order = 2.0});
    EXPECT_BEHAVIOUR(fit, Behaviour::stagnating, "unexplained-floor");
  }
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

TEST(LadderFit, RefusesErrorsAndStepsThatCannotBe) {
  EXPECT_THROW(fit_ladder(std::vector<ErrorLevel>{{{0.1, -1.0, 0.0}}}, {}), InputError);
  EXPECT_THROW(fit_ladder(std::vector<ErrorLevel>{{{0.0, 1.0, 0.0}}}, {}), InputError);
  EXPECT_THROW(fit_ladder(std::vector<ErrorLevel>{{{0.1, 1.0, nan}}}, {}), InputError);
}

}  // namespace
}  // namespace clackers::assess
