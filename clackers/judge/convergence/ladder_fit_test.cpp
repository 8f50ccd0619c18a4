#include "clackers/judge/convergence/ladder_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/judge/testing/expect_behaviour.hpp"
#include "clackers/judge/testing/synthetic_ladder.hpp"

namespace clackers::judge {
namespace {

using namespace synthetic;
using std::pow;

// Which ladder shows which behaviour is the table of verdict_sequences_test.cpp; here stand the
// numbers of a fit and the limits of its rules.

// A ladder of one step a level whose rates between levels are given, coarse to fine.
std::vector<ErrorLevel> by_rates(const std::vector<double>& rates, double first = 0.1) {
  std::vector<ErrorLevel> made{{{0.05, first, 0.0}}};
  for (const double rate : rates) {
    const auto before = made.back().front();
    made.push_back({{0.5 * before.step, before.error * std::exp2(-rate), 0.0}});
  }
  return made;
}

TEST(LadderFit, RatesAroundTheClaimThatDoNotSettleAreUndecided) {
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

TEST(LadderFit, OneNumberOverThreeOctavesIsAFloorThoughContactsHaveFewSteps) {
  const auto flat = ladder([](double h) { return 0.2 + 1e-3 * h; });
  const double finest = flat.back().back().step;
  EXPECT_BEHAVIOUR(fit_ladder(flat, {.contact_time = 15.0 * finest}), Behaviour::stagnating,
                   "contact-stiffness");
  EXPECT_BEHAVIOUR(fit_ladder(flat, {.contact_time = 9.0 * finest}), Behaviour::undecided,
                   "contact-not-resolved");
  const auto falling = ladder([](double h) { return 0.2 + 10.0 * h; });
  EXPECT_BEHAVIOUR(fit_ladder(falling, {.contact_time = 15.0 * finest}), Behaviour::undecided,
                   "contact-not-resolved");
}

TEST(LadderFit, FewRunsAboveRoundingHaveAnIntervalOfThemAll) {
  // One run a level, of which the finest three may bend by rounding.
  auto runs = ladder([](double h) { return std::pow(h, 4); }, {.levels = 5, .samples = 1});
  for (std::size_t i = 2; i < runs.size(); ++i)
    runs[i].front() = {runs[i].front().step, 0.99 * runs[i].front().error,
                       0.02 * runs[i].front().error};
  const auto fit = fit_ladder(runs, {.claimed_order = 4.0});
  EXPECT_EQ(fit.last_level, 4);
  EXPECT_LT(fit.spread, 1.0);
}

TEST(LadderFit, StepsOfUnstableRunsAreNamed) {
  const auto fit = fit_ladder(ladder([](double h) { return h > 0.011 ? 1e9 : h * h; }), {});
  EXPECT_GT(fit.stable_step, 0.009);
  EXPECT_LT(fit.stable_step, 0.011);
  EXPECT_EQ(fit_ladder(ladder([](double h) { return h * h; }), {}).stable_step, 0.0);
}

TEST(LadderFit, TheFloorOfRoundingBeginsAtItsFirstLevel) {
  auto runs = ladder([](double h) { return h * h; });
  for (std::size_t i = 5; i < runs.size(); ++i)
    for (auto& point : runs[i]) point = {point.step, 1e-7, 1e-7};
  const auto fit = fit_ladder(runs, {});
  EXPECT_EQ(fit.floor_step, runs[5].front().step);
  EXPECT_EQ(fit.floor, 1e-7);
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

TEST(LadderFit, WithoutAClaimALineIsProperWithItsOwnOrder) {
  const auto fit = fit_ladder(ladder([](double h) { return pow(h, 1.37); }), {});
  EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
  EXPECT_NEAR(fit.order, 1.37, 1e-12);
}

TEST(LadderFit, RatesThatMoveTowardsTheClaimAreUndecided) {
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

TEST(LadderFit, OneStepALevelShowsALineAndAPlateau) {
  const Shape single{.samples = 1};
  EXPECT_BEHAVIOUR(
      fit_ladder(ladder([](double h) { return h * h; }, single), {.claimed_order = 2.0}),
      Behaviour::proper, "");
  EXPECT_BEHAVIOUR(
      fit_ladder(ladder([](double h) { return h * h + 1e-4; }, single), {.claimed_order = 2.0}),
      Behaviour::stagnating, "unexplained-floor");
}

TEST(LadderFit, ResultDoesNotDependOnTheUnitOfTime) {
  for (const double unit : {1e-6, 1e6}) {
    const auto scaled = [&](double h) { return pow(h / unit, 2); };
    const auto fit = fit_ladder(ladder(scaled, {.coarsest = 0.05 * unit, .end = 20.0 * unit}),
                                {.claimed_order = 2.0});
    EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
    EXPECT_NEAR(fit.order, 2.0, 1e-9);
  }
}

TEST(LadderFit, GrowthThatSettlesIsNotDivergent) {
  const auto settles = [](double h) { return 1e-2 * (1.0 - std::sqrt(h / 0.1)); };
  EXPECT_BEHAVIOUR(fit_ladder(ladder(settles, {.levels = 4, .samples = 1}), {.claimed_order = 2.0}),
                   Behaviour::undecided, "no-convergence-yet");
}

TEST(LadderFit, ThreeFlatLevelsAloneAreTooFew) {
  EXPECT_BEHAVIOUR(fit_ladder(ladder([](double) { return 0.3; }, {.levels = 3}), {}),
                   Behaviour::undecided, "too-few-levels");
}

TEST(LadderFit, PlateauAfterAChangeOfSignStagnates) {
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

TEST(LadderFit, ChangeOfSignIsAFloorWhereAnOctaveBelowItIsSeen) {
  const auto with_zero = [](double zero) {
    return fit_ladder(ladder([=](double h) { return 1e-4 * std::abs(1.0 - pow(h / zero, 2)); }),
                      {.claimed_order = 2.0});
  };
  for (const double zero : {0.0013, 0.0008}) {
    const auto fit = with_zero(zero);
    EXPECT_BEHAVIOUR(fit, Behaviour::stagnating, "unexplained-floor");
    EXPECT_NEAR(fit.cancel_step, zero, 1e-6);
    EXPECT_NEAR(fit.floor, 1e-4, 1e-6);
    EXPECT_NEAR(fit.order, 2.0, 0.01);
  }
  for (const double zero : {0.0004, 0.0003})
    EXPECT_EQ(with_zero(zero).behaviour, Behaviour::undecided) << zero;
}

TEST(LadderFit, TwoFlatLevelsAloneAreNoPlateau) {
  const auto made = ladder([](double h) { return h > 0.00076 ? h * h : 0.00078 * 0.00078; });
  EXPECT_EQ(fit_ladder(made, {.claimed_order = 2.0}).behaviour, Behaviour::undecided);
}

TEST(LadderFit, ErrorsAsLargeAsTheMotionAreNoFloorOfACompliantContact) {
  Scatter chaos(50.0, 4);
  const auto penalty = [&](double h) {
    return 1.7 * (1.0 + 40.0 * h) + (h > 0.01 ? chaos() : 0.0);
  };
  const auto fit = fit_ladder(ladder(penalty), {.contact_time = 0.0157});
  EXPECT_BEHAVIOUR(fit, Behaviour::undecided, "larger-than-motion");
}

TEST(LadderFit, ContactThatNoStepResolvesIsUndecided) {
  const auto made = ladder([](double h) { return h * h; });
  const double finest = made.back().back().step;
  EXPECT_BEHAVIOUR(fit_ladder(made, {.claimed_order = 2.0, .contact_time = 24.9 * finest}),
                   Behaviour::undecided, "contact-not-resolved");
  EXPECT_EQ(fit_ladder(made, {.claimed_order = 2.0, .contact_time = 25.1 * finest}).behaviour,
            Behaviour::proper);
}

TEST(LadderFit, GrowthThatAcceleratesIsDivergent) {
  const auto fit = fit_ladder(ladder([](double h) { return 1e-9 * std::exp(pow(0.005 / h, 1.2)); }),
                              {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::divergent, "error-growth");
}

TEST(LadderFit, WithOneStepALevelAChangeOfSignIsNotIrregular) {
  for (const double zero : {0.02, 0.01, 0.006}) {
    const auto fit = fit_ladder(
        ladder([&](double h) { return 1e-2 * std::abs(1.0 - pow(h / zero, 2)); }, {.samples = 1}),
        {.claimed_order = 2.0});
    EXPECT_BEHAVIOUR(fit, Behaviour::stagnating, "unexplained-floor");
  }
}

TEST(LadderFit, ALineThroughTheEstimatedFloorIsFollowedToItsEnd) {
  const auto fit =
      fit_ladder(ladder([](double h) { return 2.7e3 * pow(h, 4); }), {.claimed_order = 4.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
  EXPECT_EQ(fit.last_level, 7);
}

TEST(LadderFit, LevelsBentByRoundingAreLeftOutWhereTheFloorIsSeen) {
  const auto bent = [](int levels) {
    return ladder([](double h) { return 1e-5 * h * h + 6.0 * 2.2e-16 * 20.0 / h; },
                  {.levels = levels});
  };
  const auto fit = fit_ladder(bent(8), {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
  EXPECT_EQ(fit.last_level, 3);
  // Without a level at the floor it is a floor of some cause that bends the line.
  const auto bending = fit_ladder(bent(5), {.claimed_order = 2.0});
  EXPECT_EQ(bending.behaviour, Behaviour::proper) << text(bending);
  EXPECT_GT(bending.floor, 0.0);
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

TEST(LadderFit, FinestLevelWithMostRunsFailedIsUndecided) {
  auto made = ladder([](double h) { return h * h; });
  for (std::size_t j = 0; j < 5; ++j) made.back()[j].error = nan;
  EXPECT_BEHAVIOUR(fit_ladder(made, {.claimed_order = 2.0}), Behaviour::undecided, "run-failed");
  made.back()[0].error = 1e-7;
  EXPECT_EQ(fit_ladder(made, {}).behaviour, Behaviour::proper);
}

TEST(LadderFit, ScatterAtTheLimitIsALineOrIrregularOfTheSameOrder) {
  int irregular = 0, proper = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Scatter scatter(2.1, seed);
    const auto fit =
        fit_ladder(ladder([&](double h) { return h * scatter(); }), {.claimed_order = 1.0});
    irregular += fit.behaviour == Behaviour::irregular;
    proper += fit.behaviour == Behaviour::proper;
    EXPECT_NE(fit.behaviour, Behaviour::reduced) << text(fit);
    // 32 points of deviation 0.21 leave the slope of four levels one of 0.046; four of them.
    if (fit.has_line) {
      EXPECT_NEAR(fit.order, 1.0, 0.19);
    }
  }
  EXPECT_GT(irregular, 5);
  EXPECT_GT(proper, 10);
  EXPECT_GE(irregular + proper, 98);
}

TEST(LadderFit, AnEnvelopeOfTooFewTrackedLevelsIsUndecided) {
  auto made = ladder([](double h) { return 100.0 * h; }, {.levels = 5});
  made[4][3].error *= 3.0;
  EXPECT_BEHAVIOUR(fit_ladder(made, {.claimed_order = 1.0}), Behaviour::undecided,
                   "larger-than-motion");
}

TEST(LadderFit, IrregularOrderExceedsItsSpread) {
  int irregular = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    Scatter wild(1e3, seed);
    const auto fit = fit_ladder(
        ladder([&](double h) { return 1e-2 * pow(h, 0.7) / wild(); }, {.levels = 4}), {});
    if (fit.behaviour != Behaviour::irregular) continue;
    ++irregular;
    EXPECT_GT(fit.order, fit.spread) << "seed " << seed;
  }
  EXPECT_GT(irregular, 5);
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
    EXPECT_NEAR(fit.order, 1.0, 0.3) << text(fit);
    mean += fit.order / 200;
    EXPECT_GT(fit.scatter, 4.0) << text(fit);
    EXPECT_GT(fit.spread, 0.01);
  }
  EXPECT_NEAR(mean, 1.0, 4 * 0.075 / std::sqrt(200.0));
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

TEST(LadderFit, EnvelopeHasTheLargestErrorOfEachLevelWithItsStep) {
  auto made = ladder([](double h) { return h; }, {.levels = 4});
  made[1][5].error = 7.0;
  const auto fit = fit_ladder(made, {});
  ASSERT_EQ(fit.steps.size(), 4u);
  EXPECT_EQ(fit.steps[1], made[1][5].step);
  EXPECT_EQ(fit.errors[1], 7.0);
  EXPECT_EQ(fit.steps[2], made[2][0].step);
  EXPECT_EQ(fit.errors[2], made[2][0].error);
}

TEST(LadderFit, ARoughFlatLadderStagnates) {
  int stagnating = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Scatter scatter(3.0, seed);
    const auto fit =
        fit_ladder(ladder([&](double) { return 1e-3 * scatter(); }), {.claimed_order = 1.0});
    EXPECT_TRUE(fit.behaviour == Behaviour::stagnating || fit.behaviour == Behaviour::undecided)
        << text(fit);
    stagnating += fit.behaviour == Behaviour::stagnating;
  }
  // The slope over 32 points has a standard deviation of 0.07; with its spread it stays below 0.3
  // in 98 of 100.
  EXPECT_GE(stagnating, 45);
}

TEST(LadderFit, RoughErrorsAsLargeAsTheMotionAreUndecided) {
  Scatter scatter(1.4, 3);
  const auto fit =
      fit_ladder(ladder([&](double) { return 1.2 * scatter(); }), {.claimed_order = 1.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::undecided, "larger-than-motion");
}

TEST(LadderFit, RoughGrowthIsDivergent) {
  Scatter scatter(5.0, 7);
  const auto fit =
      fit_ladder(ladder([&](double h) { return 1e-6 / h * scatter(); }), {.claimed_order = 1.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::divergent, "error-growth");
}

TEST(LadderFit, ZerosAfterCoarseFailuresAreNotExact) {
  const auto fit = fit_ladder(ladder([](double h) { return h > 0.02 ? nan : 0.0; }), {});
  EXPECT_BEHAVIOUR(fit, Behaviour::undecided, "run-failed");
  EXPECT_BEHAVIOUR(fit_ladder({}, {.claimed_order = 2.0}), Behaviour::undecided, "too-few-levels");
}

TEST(LadderFit, ASlopeThatNoMethodHasIsTheFloorOfAnotherLimit) {
  const auto made = ladder([](double h) { return std::pow(h, 0.25); });
  const auto alone = fit_ladder(made, {.claimed_order = 1.0});
  EXPECT_BEHAVIOUR(alone, Behaviour::reduced, "");
  const auto other = fit_ladder(made, {.claimed_order = 1.0, .wrong_limit = true});
  EXPECT_BEHAVIOUR(other, Behaviour::stagnating, "wrong-limit");
  const auto steeper = fit_ladder(ladder([](double h) { return std::pow(h, 0.35); }),
                                  {.claimed_order = 1.0, .wrong_limit = true});
  EXPECT_BEHAVIOUR(steeper, Behaviour::reduced, "");
}

}  // namespace
}  // namespace clackers::judge
