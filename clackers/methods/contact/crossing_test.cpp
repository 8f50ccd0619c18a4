#include "clackers/methods/contact/crossing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace clackers::methods {
namespace {

constexpr double crossing_rounding = 1e-15;

// The first crossing of g in [0, end]; the rate by its own formula.
std::optional<double> find(const std::function<double(double)>& g,
                           const std::function<double(double)>& rate, double end,
                           int budget = 200) {
  const auto at = [&](double s) { return GapSample{s, g(s), rate(s)}; };
  return first_crossing(at, at(0.0), at(end), crossing_rounding, budget);
}

TEST(Crossing, IsFoundToTheLastPlaceOnTheOpenSide) {
  const auto g = [](double s) { return std::cos(3 * s); };
  const auto s = find(
      g, [](double x) { return -3 * std::sin(3 * x); }, 0.7);
  ASSERT_TRUE(s);
  EXPECT_NEAR(*s, std::acos(-1.0) / 6, 3e-16);
  EXPECT_GE(g(*s), 0.0);
}

TEST(Crossing, IsTheFirstOfTwoInsideAStepThatIsOpenAtBothEnds) {
  const auto g = [](double s) { return (s - 0.5) * (s - 0.52); };
  const auto s = find(
      g, [](double x) { return 2 * x - 1.02; }, 1.0);
  ASSERT_TRUE(s);
  EXPECT_NEAR(*s, 0.5, 1e-14);
}

TEST(Crossing, IsTheFirstOfThree) {
  const auto g = [](double s) { return -(s - 0.2) * (s - 0.5) * (s - 0.9); };
  const auto rate = [](double s) {
    return -((s - 0.5) * (s - 0.9) + (s - 0.2) * (s - 0.9) + (s - 0.2) * (s - 0.5));
  };
  const auto s = find(g, rate, 1.0);
  ASSERT_TRUE(s);
  EXPECT_NEAR(*s, 0.2, 1e-14);
}

TEST(Crossing, IsNoneWhereTheGapComesNearOnly) {
  const auto rate = [](double x) { return 2 * (x - 0.37); };
  for (const double depth : {1e-1, 1e-6, 1e-12})
    EXPECT_FALSE(find([&](double s) { return (s - 0.37) * (s - 0.37) + depth; }, rate, 1.0))
        << depth;
  EXPECT_FALSE(
      find([&](double s) { return (s - 0.37) * (s - 0.37) - 0.1 * crossing_rounding; }, rate, 1.0));
}

TEST(Crossing, IsFoundHoweverShallowTheDipAboveRounding) {
  for (const double depth : {1e-2, 1e-6, 1e-12}) {
    const auto s = find([&](double x) { return (x - 0.37) * (x - 0.37) - depth; },
                        [](double x) { return 2 * (x - 0.37); }, 1.0);
    ASSERT_TRUE(s) << depth;
    // Flat there: a crossing_rounding 1e-16 of g moves the root by 1e-16 / (2 sqrt(depth)).
    EXPECT_NEAR(*s, 0.37 - std::sqrt(depth), 1e-16 + 2e-16 / std::sqrt(depth)) << depth;
  }
}

TEST(Crossing, IsNoneForAContactThatLeaves) {
  EXPECT_FALSE(find([](double s) { return s; }, [](double) { return 1.0; }, 1.0));
  // Left with rate 0 and a crossing_rounding of the wrong sign in both.
  EXPECT_FALSE(find([](double s) { return 5 * s * s - 1e-17; },
                    [](double s) { return 10 * s - 1e-17; }, 1.0));
}

TEST(Crossing, IsAtOnceForAContactThatIsClosedAndCloses) {
  const auto s = find([](double x) { return -x; }, [](double) { return -1.0; }, 1.0);
  ASSERT_TRUE(s);
  EXPECT_EQ(*s, 0.0);
}

TEST(Crossing, IsTheSecondZeroForAContactThatLeavesAndComesBack) {
  const auto s =
      find([](double x) { return x * (0.3 - x); }, [](double x) { return 0.3 - 2 * x; }, 1.0);
  ASSERT_TRUE(s);
  EXPECT_NEAR(*s, 0.3, 1e-15);
}

TEST(Crossing, EndsForNoiseAndForWhatIsNoNumber) {
  int calls = 0;
  const auto noise = [&](double s) { return ++calls, 1e-9 * std::sin(1e12 * s); };
  find(
      noise, [](double) { return -1.0; }, 1.0);
  EXPECT_LT(calls, 400);
  EXPECT_FALSE(find([](double) { return NAN; }, [](double) { return NAN; }, 1.0));
  // Without anything to spend, a step that ends violated counts as one crossing.
  EXPECT_TRUE(find([](double s) { return std::cos(20 * s) - 0.9; },
                   [](double s) { return -20 * std::sin(20 * s); }, 0.5, 0));
}

}  // namespace
}  // namespace clackers::methods
