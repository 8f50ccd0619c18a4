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

TEST(LadderFit, GrowthThatSettlesIsNotDivergent) {
  const auto settles = [](double h) { return 1e-2 * (1.0 - std::sqrt(h / 0.1)); };
  EXPECT_BEHAVIOUR(
      fit_ladder(ladder(settles, {.levels = 4, .neighbours = 1}), {.claimed_order = 2.0}),
      Behaviour::undecided, "no-convergence-yet");
}

TEST(LadderFit, ThreeFlatLevelsAloneAreTooFew) {
  EXPECT_BEHAVIOUR(fit_ladder(ladder([](double) { return 0.3; }, {.levels = 3}), {}),
                   Behaviour::undecided, "too-few-levels");
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

TEST(LadderFit, WithOneStepALevelAChangeOfSignIsNotIrregular) {
  for (const double zero : {0.02, 0.01, 0.006}) {
    const auto fit =
        fit_ladder(ladder([&](double h) { return 1e-2 * std::abs(1.0 - pow(h / zero, 2)); },
                          {.neighbours = 1}),
                   {.claimed_order = 2.0});
    EXPECT_BEHAVIOUR(fit, Behaviour::stagnating, "unexplained-floor");
  }
}

}  // namespace
}  // namespace clackers::assess
