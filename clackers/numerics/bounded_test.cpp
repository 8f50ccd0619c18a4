#include "clackers/numerics/bounded.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace clackers::numerics {
namespace {

// The same formula in binary64 steps as long doubles with a large error: intervals must contain the
// formula evaluated anywhere inside.
TEST(Bounded, ErrorsOfOperandsAreCarriedOn) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.2, 3.0), inside(-1.0, 1.0);
  for (int trial = 0; trial < 500; ++trial) {
    const long double width = 1e-6L;
    const Bounded a(uniform(random), width), b(uniform(random), width);
    const auto formula = [](const auto& x, const auto& y) {
      using std::cos, std::exp, std::sin, std::sqrt, std::expm1, std::sinh;
      return sin(x * y) / y - exp(-x) * cos(y) + sqrt(x + y) * expm1(x) * sinh(y);
    };
    const auto bounded = formula(a, b);
    for (int i = 0; i < 4; ++i) {
      const long double x = a.value + width * inside(random), y = b.value + width * inside(random);
      EXPECT_LE(std::abs(formula(x, y) - bounded.value), bounded.error);
    }
    EXPECT_LT(bounded.error, 2e-3L);  // two-sided: derivatives of the formula are below 500 here
  }
}

// The true number may lie at either end of its bound.
TEST(Bounded, FunctionsCarryTheErrorOfTheirArgumentOn) {
  constexpr long double width = 1e-6L;
  for (const double at : {-3.0, -0.4, 0.0, 0.2, 1.5}) {
    const Bounded x(at, width);
    const auto expect_within = [&](const Bounded& found, auto function) {
      for (const long double end : {at - width, at + width})
        EXPECT_LE(std::abs(function(end) - found.value), found.error) << at;
      EXPECT_LT(found.error, 30.0L * width) << at;
    };
    expect_within(atan(x), [](long double y) { return std::atan(y); });
    expect_within(sin(x), [](long double y) { return std::sin(y); });
    expect_within(cos(x), [](long double y) { return std::cos(y); });
    expect_within(exp(x), [](long double y) { return std::exp(y); });
  }
}

// Far from 0 the slope of the arctangent is small, and at 0 that of the square root is large.
TEST(Bounded, ErrorsGoWithTheSlope) {
  for (const long double at : {-50.0L, 50.0L})
    for (const long double width : {40.0L, 1e-3L}) {
      const auto found = atan(Bounded(at, width));
      for (const long double end : {at - width, at + width})
        EXPECT_LE(std::abs(std::atan(end) - found.value), found.error) << at;
      EXPECT_LT(found.error, width / 100.0L) << at;
    }
  const auto root = sqrt(Bounded(2.0L, 1.0L));
  EXPECT_LE(std::sqrt(2.0L) - 1.0L, root.error);
  EXPECT_LT(root.error, 0.42L);
}

// Which of the two is the smaller one, or whether a number is positive, may not be certain.
TEST(Bounded, MinimumAndPositivePartCarryTheLargerErrorOn) {
  constexpr long double width = 0x1p-20L;
  for (const double at : {-1.0, -0x1p-21, 0.0, 0x1p-21, 1.0})
    for (const long double end : {at - width, at + width}) {
      const Bounded x(at, width);
      const auto least = min(x, Bounded(0.0)), most = positive_part(x);
      EXPECT_LE(std::abs(std::min(end, 0.0L) - least.value), least.error) << at;
      EXPECT_LE(std::abs(std::max(end, 0.0L) - most.value), most.error) << at;
    }
  EXPECT_EQ(min(Bounded(2.0), Bounded(-3.0)).value, -3.0L);
}

TEST(Bounded, DivisionByWhatMayBeZeroHasNoBound) {
  EXPECT_TRUE(std::isinf((Bounded(1.0) / Bounded(1e-9L, 2e-9L)).error));
  EXPECT_TRUE(std::isinf(sqrt(Bounded(1e-9L, 2e-9L)).error));
  EXPECT_LT((Bounded(1.0) / Bounded(3.0)).error, 1e-19L);
}

TEST(Bounded, NearestDoubleHasHalfAUnitAndTheError) {
  const auto third = Bounded(1.0) / Bounded(3.0);
  EXPECT_EQ(third.nearest(), 1.0 / 3.0);
  EXPECT_LE(third.nearest_error(), 0.51 * 0x1p-53);
  EXPECT_GE(third.nearest_error(), 1.0 / 3.0 * 0x1p-53);
  EXPECT_FALSE(std::signbit((-Bounded(0.0)).nearest()));
}

}  // namespace
}  // namespace clackers::numerics
