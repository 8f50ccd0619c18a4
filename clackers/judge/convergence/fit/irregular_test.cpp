#include "clackers/judge/convergence/fit/irregular.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/judge/testing/synthetic_ladder.hpp"

namespace clackers::judge {
namespace {

using namespace synthetic;

bool zigzag(const std::vector<ErrorLevel>& made) {
  return zigzags(view(made), 0, int(made.size()) - 1);
}

TEST(Irregular, IndependentScatterZigzags) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    Scatter scatter(10.0, seed), single(30.0, seed);
    EXPECT_TRUE(zigzag(ladder([&](double h) { return h * scatter(); }))) << "seed " << seed;
  }
}

TEST(Irregular, SmoothCurvesDoNotZigzagHoweverBent) {
  for (const int samples : {1, 8}) {
    const Shape shape{.samples = samples};
    EXPECT_FALSE(zigzag(ladder([](double h) { return h * h; }, shape)));
    EXPECT_FALSE(zigzag(ladder([](double h) { return std::tanh(1e4 * h * h); }, shape)));
    for (const double zero : {0.01, 0.003, 0.001, 0.0006, 0.0004})
      EXPECT_FALSE(zigzag(ladder([&](double h) { return std::abs(h * h - zero * zero); }, shape)))
          << zero;
  }
}

TEST(Irregular, OnlyTheFinestLevelsCount) {
  Scatter coarse(10.0, 3), fine(10.0, 4);
  EXPECT_FALSE(zigzag(ladder([&](double h) { return h * (h > 0.0065 ? coarse() : 1.0); })));
  EXPECT_TRUE(zigzag(ladder([&](double h) { return h * (h > 0.0065 ? 1.0 : fine()); })));
}

TEST(Irregular, AFewRoughPlacesAmongManySmoothOnesDoNotCount) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Scatter scatter(10.0, seed);
    EXPECT_FALSE(zigzag(ladder([&](double h) { return h * (h > 0.0021 ? scatter() : 1.0); })))
        << seed;
  }
}

TEST(Irregular, ABendThatKeepsItsSideIsNoZigzag) {
  const auto ever_flatter = [](double h) { return std::exp(-0.4 * std::pow(std::log(h), 2)); };
  EXPECT_FALSE(zigzag(ladder(ever_flatter, {.levels = 12, .samples = 1})));
}

TEST(Irregular, AFailedLevelEndsTheEnvelope) {
  auto made = ladder([](double h) { return h; });
  for (auto& point : made[2]) point.error = nan;
  EXPECT_EQ(envelope(view(made), 0, 7)->first, 3);
}

TEST(Irregular, TheEnvelopeGoesThroughTheLargestErrors) {
  auto made = ladder([](double h) { return h; });
  for (auto& level : made)
    for (std::size_t j = 0; j < level.size(); ++j)
      if (j != 3) level[j].error /= 20.0;
  const auto upper = envelope(view(made), 0, 7);
  ASSERT_TRUE(upper.has_value());
  EXPECT_NEAR(upper->line.slope, 1.0, 1e-12);
  EXPECT_NEAR(std::exp(upper->line.intercept), 1.0, 1e-12);
  EXPECT_NEAR(upper->scatter, 20.0, 1e-9);
  EXPECT_EQ(upper->first, 0);
}

TEST(Irregular, ABlendOfTwoOrdersHasTheLowerOne) {
  for (const double second : {30.0, 100.0}) {
    auto made = ladder([&](double h) { return h + second * h * h; });
    for (auto& level : made)
      for (std::size_t j = 0; j < level.size(); ++j)
        if (j != 3) level[j].error /= 20.0;
    const auto upper = envelope(view(made), 0, 7);
    ASSERT_TRUE(upper.has_value());
    EXPECT_GT(upper->line.slope - upper->line.slope_spread, 1.0) << second;
    EXPECT_EQ(upper->order, 1.0) << second;
    EXPECT_GE(upper->spread, upper->line.slope - 1.0) << second;
  }
}

TEST(Irregular, CoarseLevelsFarOffTheLineAreLeftOut) {
  for (const double off : {0.1, 10.0}) {
    const auto made = ladder([&](double h) { return h * (h > 0.013 ? off : 1.0); });
    EXPECT_EQ(envelope(view(made), 0, 7)->first, 2) << off;
    EXPECT_NEAR(envelope(view(made), 0, 7)->line.slope, 1.0, 1e-12) << off;
  }
  for (const double little : {0.3, 3.0}) {
    const auto made = ladder([&](double h) { return h * (h > 0.026 ? little : 1.0); });
    EXPECT_EQ(envelope(view(made), 0, 7)->first, 0) << little;
  }
  const auto all = ladder([](double h) { return h; });
  EXPECT_EQ(envelope(view(all), 4, 7)->first, 4);
  EXPECT_FALSE(envelope(view(all), 5, 7).has_value());
}

bool swinging(const std::vector<ErrorLevel>& made) {
  return swings(view(made), 0, int(made.size()) - 1);
}

TEST(Swings, OscillationsWithTheLogarithmOfTheStepSwing) {
  for (const double period : {0.5, 1.0, 2.0, 3.0})
    EXPECT_TRUE(swinging(ladder([&](double h) {
      return h * std::exp(std::sin(2.0 * std::numbers::pi * std::log2(h) / period));
    }))) << period;
}

TEST(Swings, OscillationsBelowTheRootOfTheScatterOfALineDoNot) {
  const auto of = [](double amplitude) {
    return ladder([=](double h) {
      return h * std::pow(amplitude, std::sin(2.0 * std::numbers::pi * std::log2(h)));
    });
  };
  EXPECT_FALSE(swinging(of(1.2)));
  EXPECT_TRUE(swinging(of(1.28)));
}

TEST(Swings, BendsAndOnePassageThroughZeroDoNot) {
  EXPECT_FALSE(swinging(ladder([](double h) { return h + 100.0 * h * h; })));
  EXPECT_FALSE(swinging(ladder([](double h) { return std::tanh(1e4 * h * h); })));
  for (const double zero : {0.03, 0.01, 0.003, 0.001, 0.0006, 0.0004}) {
    EXPECT_FALSE(swinging(ladder([&](double h) { return std::abs(h * h - zero * zero); }))) << zero;
    EXPECT_FALSE(swinging(ladder([&](double h) { return std::abs(h * h * (h - zero)); }))) << zero;
  }
}

TEST(Swings, FewerThanTenPointsMayLieSoByChance) {
  const auto stairs = [](double h) { return std::exp2(2.0 * std::floor(0.5 * std::log2(h))); };
  EXPECT_TRUE(swinging(ladder(stairs, {.samples = 2})));
  EXPECT_FALSE(swinging(ladder(stairs, {.levels = 9, .samples = 1})));
}

TEST(Swings, OnlyTheGivenLevelsCount) {
  Scatter scatter(10.0, 3);
  const auto made = ladder([&](double h) { return h * (h > 0.0065 ? scatter() : 1.0); });
  EXPECT_TRUE(swings(view(made), 0, 7));
  EXPECT_FALSE(swings(view(made), 3, 7));
}

}  // namespace
}  // namespace clackers::judge
