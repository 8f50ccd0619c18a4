#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/assess/convergence/fit/irregular.hpp"
#include "clackers/assess/testing/synthetic_ladder.hpp"

namespace clackers::assess {
namespace {

using namespace synthetic;

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
  EXPECT_TRUE(swinging(ladder(stairs, {.neighbours = 2})));
  EXPECT_FALSE(swinging(ladder(stairs, {.levels = 9, .neighbours = 1})));
}

TEST(Swings, OnlyTheGivenLevelsCount) {
  Scatter scatter(10.0, 3);
  const auto made = ladder([&](double h) { return h * (h > 0.0065 ? scatter() : 1.0); });
  EXPECT_TRUE(swings(view(made), 0, 7));
  EXPECT_FALSE(swings(view(made), 3, 7));
}

}  // namespace
}  // namespace clackers::assess
