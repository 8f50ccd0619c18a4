#include "clackers/judge/convergence/step_ladder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "clackers/base/error.hpp"

namespace clackers::judge {
namespace {

std::vector<double> default_impacts() {
  std::vector<double> times;
  for (int k = 1; k <= 6; ++k)
    times.push_back((k - 0.5) * std::numbers::pi / std::sqrt(1.0 - 0.0025));
  return times;
}

double clearance(double h, const std::vector<double>& impacts) {
  double least = 0.5;
  for (const double t : impacts) least = std::min(least, std::abs(t / h - std::round(t / h)));
  return least;
}

TEST(StepLadder, TheDefaultHasEightLevelsOfEightStepsEach) {
  const auto ladder = step_ladder({}, 20.0, default_impacts());
  ASSERT_EQ(ladder.size(), 8u);
  for (int i = 0; i < 8; ++i) {
    const auto& level = ladder[std::size_t(i)];
    ASSERT_EQ(level.steps.size(), 8u);
    ASSERT_EQ(level.counts.size(), 8u);
    EXPECT_DOUBLE_EQ(level.nominal, 0.05 * std::exp2(-i));
    for (int j = 0; j < 8; ++j) {
      const double wanted = 0.05 * std::exp2(-i - j / 8.0);
      EXPECT_EQ(level.steps[std::size_t(j)], 20.0 / double(level.counts[std::size_t(j)]));
      // A quarter of the way to the next neighbour, and half a step count of rounding.
      EXPECT_NEAR(level.steps[std::size_t(j)] / wanted, 1.0,
                  0.25 * (std::exp2(0.125) - 1.0) + 0.5 / 400.0);
    }
  }
}

TEST(StepLadder, ImpactsStayAwayFromWholeNumbersOfSteps) {
  const auto impacts = default_impacts();
  for (const auto& level : step_ladder({}, 20.0, impacts))
    for (const double h : level.steps) EXPECT_GE(clearance(h, impacts), 0.25 / 6 - 1e-9) << h;
}

TEST(StepLadder, TheNearestNumberThatKeepsAwayIsTaken) {
  const auto impacts = default_impacts();
  const auto ladder = step_ladder({}, 20.0, impacts);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      const double wanted = std::round(400.0 * std::exp2(i + j / 8.0));
      const auto taken = double(ladder[std::size_t(i)].counts[std::size_t(j)]);
      const double away = std::abs(taken - wanted);
      for (double n = wanted - away + 1.0; n < wanted + away; n += 1.0)
        EXPECT_LT(clearance(20.0 / n, impacts), 0.25 / 6 + 1e-9) << n << " instead of " << taken;
    }
}

TEST(StepLadder, ManyImpactsGetTheRoomThereIs) {
  std::vector<double> impacts;
  for (int k = 1; k <= 300; ++k) impacts.push_back((k - 0.5) * 3.1455 / 50.0);
  for (const auto& level : step_ladder({.levels = 5}, 20.0, impacts))
    for (const double h : level.steps) EXPECT_GE(clearance(h, impacts), 0.25 / 300 - 1e-9) << h;
}

TEST(StepLadder, WhereNoNumberKeepsAwayTheBestIsTaken) {
  // t = end / 2 and t = end / 3: a number of steps divisible by neither is the best.
  const std::vector<double> impacts{10.0, 20.0 / 3.0};
  for (const auto& level : step_ladder({.levels = 3}, 20.0, impacts))
    for (const auto n : level.counts) {
      EXPECT_EQ(n % 2, 1) << n;
      EXPECT_NE(n % 3, 0) << n;
    }
}

TEST(StepLadder, OfNumbersThatAllComeTooNearTheFurthestIsTaken) {
  // 8 to 12 are within reach of 10. Impacts lie 0.001 steps behind a whole one for each, 0.004
  // for 11.
  const std::vector<double> impacts{3.001 / 10, 3.004 / 11, 2.001 / 9, 5.001 / 12, 5.001 / 8};
  const auto ladder =
      step_ladder({.coarsest = 0.1, .levels = 1, .samples_per_level = 1}, 1.0, impacts);
  EXPECT_EQ(ladder[0].counts, std::vector<long long>{11});
}

TEST(StepLadder, NoStepLeavesItsPlaceFurtherThanAQuarterOfTheWayToTheNext) {
  std::vector<double> everywhere;  // at every whole step of every number up to 130
  for (int n = 2; n < 130; ++n)
    for (int k = 1; k < n; ++k) everywhere.push_back(double(k) / n);
  for (int samples : {1, 2, 5}) {
    const double reach = 0.25 * (std::exp2(1.0 / samples) - 1.0);
    const auto ladder = step_ladder({.coarsest = 0.025, .levels = 2, .samples_per_level = samples},
                                    1.0, everywhere);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < samples; ++j) {
        const double wanted = 40.0 * std::exp2(i + double(j) / samples);
        EXPECT_NEAR(double(ladder[std::size_t(i)].counts[std::size_t(j)]), wanted,
                    reach * wanted + 0.5);
      }
  }
}

TEST(StepLadder, ImpactsOutsideTheRunDoNotCount) {
  const auto without = step_ladder({}, 20.0, {});
  const auto beyond = step_ladder({}, 20.0, std::vector<double>{0.0, 20.0, 25.0, -1.0});
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(without[i].counts, beyond[i].counts);
  auto impacts = default_impacts();
  const auto some = step_ladder({}, 20.0, impacts);
  impacts.insert(impacts.end(), {0.0, 20.0, 25.0, -1.0});
  const auto more = step_ladder({}, 20.0, impacts);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(some[i].counts, more[i].counts);
  EXPECT_NE(some[0].counts, without[0].counts);
  EXPECT_EQ(without[0].counts.front(), 400);
  EXPECT_EQ(without[7].counts.front(), 400 * 128);
}

TEST(StepLadder, AtRandomNumbersAscendAndNoLevelIsEmpty) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 3.0);
  for (int trial = 0; trial < 300; ++trial) {
    const RefinementPlan plan{.coarsest = 20.0 * std::pow(10.0, -share(random)),
                              .levels = 1 + trial % 6,
                              .samples_per_level = 1 + trial % 17};
    SCOPED_TRACE(testing::Message() << "seed 7 trial " << trial << " coarsest " << plan.coarsest);
    long long previous = 0;
    const auto ladder = step_ladder(plan, 20.0, default_impacts());
    EXPECT_EQ(ladder.size(), std::size_t(plan.levels));
    for (const auto& level : ladder) {
      EXPECT_FALSE(level.counts.empty());
      EXPECT_LE(level.counts.size(), std::size_t(plan.samples_per_level));
      for (const auto n : level.counts) {
        EXPECT_GT(n, previous);
        previous = n;
      }
    }
  }
}

std::string code_of(const RefinementPlan& plan, double end = 20.0) {
  try {
    step_ladder(plan, end, {});
  } catch (const InputError& error) {
    return std::string(error.code().name());
  }
  return "nothing";
}

TEST(StepLadder, RefusesStepsThatAreNotPositiveAndFinite) {
  EXPECT_EQ(code_of({.coarsest = 0.0}), "step-not-positive");
  EXPECT_EQ(code_of({.coarsest = -0.1}), "step-not-positive");
  EXPECT_EQ(code_of({.coarsest = NAN}), "not-a-number");
  EXPECT_EQ(code_of({.coarsest = INFINITY}), "not-finite");
  EXPECT_EQ(code_of({.coarsest = 20.1}), "step-not-positive");
  EXPECT_EQ(code_of({.coarsest = 20.0, .levels = 2}), "nothing");
  EXPECT_EQ(code_of({}, 0.0), "out-of-range");
}

TEST(StepLadder, RefusesLevelsAndNeighboursOutsideTheirRange) {
  EXPECT_EQ(code_of({.levels = 0}), "out-of-range");
  EXPECT_EQ(code_of({.samples_per_level = 0}), "out-of-range");
  EXPECT_EQ(code_of({.samples_per_level = 65}), "out-of-range");
  EXPECT_EQ(code_of({.levels = 1, .samples_per_level = 64}), "nothing");
}

TEST(StepLadder, RefusesMoreStepsThanCanEnd) {
  EXPECT_EQ(code_of({.coarsest = 2.1e-8, .levels = 1, .samples_per_level = 1}), "nothing");
  EXPECT_EQ(code_of({.coarsest = 1.9e-8, .levels = 1, .samples_per_level = 1}), "too-many-steps");
  EXPECT_EQ(code_of({.levels = 1000000000}), "too-many-steps");
  EXPECT_EQ(code_of({.coarsest = 5e-324}), "too-many-steps");
  try {
    step_ladder({.levels = 40}, 20.0, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("40 levels from coarsest = 0.05 s"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("fewer levels"), std::string::npos);
  }
}

}  // namespace
}  // namespace clackers::judge
