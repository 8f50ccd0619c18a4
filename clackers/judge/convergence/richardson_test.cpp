#include "clackers/judge/convergence/richardson.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "clackers/base/error.hpp"
#include "clackers/judge/testing/synthetic_ladder.hpp"
#include "clackers/judge/testing/synthetic_runs.hpp"

namespace clackers::judge {
namespace {

using namespace synthetic;
using std::pow;
using Values = std::vector<double>;

constexpr SelfContext second_order{.claimed_order = 2.0};

std::vector<Response> sequence(const std::function<Values(double)>& at, int levels = 8) {
  return chain(runs(at, levels));
}

TEST(Richardson, APurePowerIsExtrapolatedToItsLimit) {
  const auto found = extrapolate(sequence([](double h) {
                                   return Values{5.0 + h * h, -h * h};
                                 }),
                                 second_order, 3.0);
  ASSERT_TRUE(found.bounded);
  EXPECT_NEAR(found.value[0], 5.0, 1e-14);
  EXPECT_NEAR(found.value[1], 0.0, 1e-14);
  EXPECT_EQ(found.level, 7);
  // h^2 (1 - 1/4) / 3 with h = 0.1 / 64.
  EXPECT_NEAR(found.bound, pow(0.1 / 64, 2) / 4, 1e-14);
  EXPECT_NEAR(*found.estimate, 0.0, 1e-14);
}

TEST(Richardson, TheBoundHoldsAndTheEstimateIsCloseForRandomExpansions) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int bounded = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const double a = any(random), b = any(random), c = 3.0 * any(random), d = 3.0 * any(random);
    const auto found = extrapolate(
        sequence([&](double h) {
          return Values{1.0 + a * h * h + c * h * h * h, 2.0 + b * h * h + d * h * h * h};
        }),
        second_order, 3.0);
    if (!found.bounded) continue;
    ++bounded;
    const double off = std::max(std::abs(found.value[0] - 1.0), std::abs(found.value[1] - 2.0));
    EXPECT_LE(off, found.bound) << "trial " << trial;
    // Two terms alone: the estimate is the error itself.
    EXPECT_NEAR(*found.estimate, off, 1e-3 * off + 1e-14) << "trial " << trial;
  }
  EXPECT_GT(bounded, 150);
}

TEST(Richardson, TheMidpointRuleGainsTwoOrders) {
  const auto found = extrapolate(
      chain(runs([](double h) { return Values{midpoint(h)}; }, 7, 1, 0.2)), second_order, 4.0);
  ASSERT_TRUE(found.bounded);
  const double off = std::abs(found.value[0] - std::cos(3.0));
  EXPECT_LT(off, 1e-3 * found.bound);
  EXPECT_NEAR(*found.estimate, off, 0.05 * off);
}

TEST(Richardson, UnevenRatiosAreTakenAsTheyAre) {
  std::vector<Response> made;
  for (const double h : {0.1, 0.07, 0.03, 0.02, 0.008, 0.003})
    made.push_back({h, {1.0 - 2.0 * h * h, 0.5 + h * h}, 0.0});
  const auto found = extrapolate(made, second_order);
  ASSERT_TRUE(found.bounded);
  EXPECT_NEAR(found.value[0], 1.0, 1e-14);
  EXPECT_NEAR(found.bound, 2.0 * 0.003 * 0.003, 1e-14);
  EXPECT_FALSE(found.estimate.has_value());
}

TEST(Richardson, AnErrorWhoseSignFlipsIsRefusedAlthoughItsDifferencesAreProper) {
  int level = 0;
  const auto made = sequence([&](double h) { return Values{(++level % 2 ? 1 : -1) * h * h}; });
  std::vector<ResponseLevel> levels;
  for (const auto& run : made) levels.push_back({run});
  EXPECT_TRUE(self_convergence(levels, second_order).proper);
  const auto found = extrapolate(made, second_order);
  EXPECT_FALSE(found.bounded);
  EXPECT_EQ(found.reason, "differences-turn");
  // Rightly: extrapolation would leave 2/3 of h^2 of the coarser run, the bound says 5/12.
}

TEST(Richardson, DifferencesThatTurnInDirectionAreRefused) {
  int level = 0;
  const auto turning = sequence([&](double h) {
    ++level;
    return Values{level % 2 ? h * h : 0.0, level % 2 ? 0.0 : h * h};
  });
  EXPECT_EQ(extrapolate(turning, second_order).reason, "differences-turn");
}

TEST(Richardson, TheDepartureAllowedIsTheOneOfTheProof) {
  EXPECT_DOUBLE_EQ(largest_departure(0.5), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(largest_departure(0.25), 0.6);
  // Second components that shrink by (1 + theta) / 4 a level depart by theta in all.
  for (const double theta : {0.55, 0.65}) {
    std::vector<Response> made;
    Values u{0.0, 0.0};
    double first = 1.0, other = 1.0;
    for (int j = 0; j < 8; ++j, first *= 0.25, other *= -0.25) {
      made.push_back({0.1 * std::exp2(-j), u, 0.0});
      u[0] += first;
      // Flips each time: departs by 2 of its own size, theta / 2 of the whole.
      u[1] += 0.5 * theta * other;
    }
    EXPECT_EQ(extrapolate(made, second_order).bounded, theta < 0.6);
  }
}

TEST(Richardson, AnImproperSequenceIsRefusedWithItsReason) {
  const auto reason = [](const std::function<Values(double)>& at, int levels = 8) {
    const auto found = extrapolate(sequence(at, levels), second_order);
    EXPECT_FALSE(found.bounded);
    EXPECT_TRUE(found.value.empty());
    return found.reason;
  };
  EXPECT_EQ(reason([](double h) { return Values{h}; }), "improper-convergence");
  EXPECT_EQ(reason([](double h) { return Values{pow(h, 4)}; }), "improper-convergence");
  EXPECT_EQ(reason([](double h) { return Values{h * h}; }, 4), "too-few-levels");
  EXPECT_EQ(reason([](double h) { return h < 0.002 ? Values{} : Values{h * h}; }), "run-failed");
  EXPECT_EQ(reason([](double) { return Values{1.0}; }), "improper-convergence");
  // Of one run a level the fit of the differences has a reason of its own.
  EXPECT_EQ(reason([](double h) { return Values{h * h * (1.0 + 0.8 * std::sin(40.0 / h))}; }),
            "improper-convergence");
  EXPECT_EQ(reason([](double h) { return Values{h * h + 1e-7 / h}; }), "improper-convergence");
}

TEST(Richardson, RoundingEndsTheRangeAndIsPartOfTheBound) {
  auto made = sequence([](double h) { return Values{1.0 + h * h}; }, 10);
  const auto clean = extrapolate(made, second_order);
  for (auto& run : made) run.floor = 1e-9;
  const auto rough = extrapolate(made, second_order);
  ASSERT_TRUE(rough.bounded);
  EXPECT_NEAR(rough.bound - clean.bound, 5.0 / 3.0 * 1e-9, 1e-12);
}

TEST(Richardson, RefusesToWorkWithoutAnOrder) {
  const auto made = sequence([](double h) { return Values{h * h}; });
  EXPECT_THROW(extrapolate(made, {}), InputError);
  EXPECT_THROW(extrapolate(made, second_order, 2.0), InputError);
}

}  // namespace
}  // namespace clackers::judge
