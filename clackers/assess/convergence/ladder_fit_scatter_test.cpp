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

TEST(LadderFit, RoughErrorsAsLargeAsTheMotionStayOutsideTheEnvelope) {
  Scatter coarse(1.2, 1), fine(10.0, 2);
  const auto saturates = [&](double h) { return h > 0.0065 ? 1.2 * coarse() : 50.0 * h / fine(); };
  const auto fit = fit_ladder(ladder(saturates), {.claimed_order = 1.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::irregular, "");
  EXPECT_EQ(fit.first_level, 3) << told(fit);
}

TEST(LadderFit, ScatterAtTheEdgeIsALineOrIrregularAndNeverAnotherOrder) {
  int irregular = 0, proper = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Scatter scatter(2.1, seed);
    const auto fit =
        fit_ladder(ladder([&](double h) { return h * scatter(); }), {.claimed_order = 1.0});
    irregular += fit.behaviour == Behaviour::irregular;
    proper += fit.behaviour == Behaviour::proper;
    EXPECT_NE(fit.behaviour, Behaviour::reduced) << told(fit);
    // 32 points of deviation 0.21 leave the slope of four levels one of 0.046; four of them.
    if (fit.has_line) {
      EXPECT_NEAR(fit.order, 1.0, 0.19);
    }
  }
  EXPECT_GT(irregular, 10);
  EXPECT_GT(proper, 10);
  EXPECT_GE(irregular + proper, 98);
}

TEST(LadderFit, AnEnvelopeOfTooFewTrackedLevelsIsUndecided) {
  auto made = ladder([](double h) { return 100.0 * h; }, {.levels = 5});
  made[4][3].error *= 3.0;
  EXPECT_BEHAVIOUR(fit_ladder(made, {.claimed_order = 1.0}), Behaviour::undecided,
                   "too-few-levels");
}

TEST(LadderFit, AnIrregularOrderIsAlwaysCertainToBePositive) {
  int irregular = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    Scatter wild(1e3, seed);
    const auto fit = fit_ladder(
        ladder([&](double h) { return 1e-2 * pow(h, 0.7) / wild(); }, {.levels = 4}), {});
    if (fit.behaviour != Behaviour::irregular) continue;
    ++irregular;
    EXPECT_GT(fit.order, fit.spread) << "seed " << seed;
  }
  EXPECT_GT(irregular, 10);
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

TEST(LadderFit, ARoughFlatLadderStagnates) {
  int stagnating = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Scatter scatter(3.0, seed);
    const auto fit =
        fit_ladder(ladder([&](double) { return 1e-3 * scatter(); }), {.claimed_order = 1.0});
    EXPECT_TRUE(fit.behaviour == Behaviour::stagnating || fit.behaviour == Behaviour::undecided)
        << told(fit);
    stagnating += fit.behaviour == Behaviour::stagnating;
  }
  // The slope over 32 points has a standard deviation of 0.07; with its spread it stays below 0.3
  // in 98 of 100.
  EXPECT_GE(stagnating, 45);
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

}  // namespace
}  // namespace clackers::assess
