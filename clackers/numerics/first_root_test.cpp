#include "clackers/numerics/first_root.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clackers::numerics {
namespace {

// cos s + c and its derivatives.
auto raised_cosine(double c, int* calls = nullptr) {
  return [=](double s) {
    if (calls != nullptr) ++*calls;
    return LocalBound{std::cos(s) + c, -std::sin(s), -std::cos(s), std::sin(s), 1.0, 1.0};
  };
}

TEST(FirstRoot, FindsTheFirstOfTwoNearbyRoots) {
  // cos s + 1 - dip is below 0 for sqrt(8 dip) around pi.
  for (const double dip : {1e-3, 1e-6, 1e-9}) {
    const auto root = first_root(raised_cosine(1.0 - dip), 0.0, 100.0, 1e-9, 100000);
    ASSERT_EQ(root.status, FirstRoot::Status::found);
    const double known = std::numbers::pi - std::acos(1.0 - dip);
    // The slope there is sqrt(2 dip); f is rounded to 2^-52.
    EXPECT_NEAR(root.s, known, 4.0 * 0x1p-52 / std::sqrt(2.0 * dip) + 1e-15) << dip;
  }
}

TEST(FirstRoot, ConvergesWithThirdOrder) {
  int calls = 0;
  const auto root = first_root(raised_cosine(0.3, &calls), 0.0, 100.0, 1e-9, 100);
  EXPECT_NEAR(root.s, std::acos(-0.3), 4e-16);
  EXPECT_LE(calls, 5);
}

TEST(FirstRoot, PassesANearMissInFewSteps) {
  for (const double margin : {1e-2, 1e-5, 1e-10}) {
    int calls = 0;
    const auto root = first_root(raised_cosine(1.0 + margin, &calls), 0.0, 6.0, 1e-9, 1000);
    EXPECT_EQ(root.status, FirstRoot::Status::none) << margin;
    EXPECT_LE(calls, 60) << margin;
  }
}

TEST(FirstRoot, SaysWhetherThereIsNone) {
  const auto above = raised_cosine(1.01);
  EXPECT_EQ(first_root(above, 0.0, 50.0, 1e-9, 100000).status, FirstRoot::Status::none);
  EXPECT_EQ(first_root(above, 0.0, 50.0, 1e-9, 3).status, FirstRoot::Status::undecided);
  const auto line = [](double s) { return LocalBound{1.0 - s, -1.0, 0.0, 0.0, 0.0, 0.0, 0.3}; };
  EXPECT_NEAR(first_root(line, 0.0, 50.0, 1e-9, 100).s, 1.0, 1e-15);
  EXPECT_EQ(first_root(line, 0.0, 0.9, 1e-9, 100).status, FirstRoot::Status::none);
  // To the root itself in one step, without a bound on its slope there: no step beyond it.
  const auto met = [](double s) {
    return LocalBound{0.25 - s, -1.0, 0.0, 0.0, 0.0, 0.0, 0.3, false};
  };
  EXPECT_EQ(first_root(met, 0.0, 50.0, 1e-9, 100).s, 0.25);
  const auto broken = [](double) { return LocalBound{std::nan("")}; };
  EXPECT_EQ(first_root(broken, 0.0, 1.0, 1e-9, 100).status, FirstRoot::Status::undecided);
}

TEST(FirstRoot, BoundsOfTheNextZeroHoldTheZerosOfTheExtremeCubics) {
  for (const double value : {0.0, 1e-3, 1.0})
    for (const double slope : {-2.0, -0.01, 0.0, 0.5})
      for (const double second : {-3.0, 0.0, 2.0}) {
        if (value == 0.0 && slope <= 0.0) continue;
        const LocalBound f{value, slope, second, 0.0, std::abs(second) + 5.0, 1.5};
        const auto [lo, hi] = next_zero(f);
        const auto cubic = [&](double third, double x) {
          return value + x * (slope + x * (second / 2.0 + x * third / 6.0));
        };
        for (int i = 1; i < 100; ++i) {
          EXPECT_GE(cubic(-1.5, lo * i / 100.0), 0.0) << value << ' ' << slope << ' ' << second;
        }
        if (std::isfinite(hi)) {
          EXPECT_LE(cubic(1.5, hi), 1e-15);
          EXPECT_LE(lo, hi);
        }
      }
}

}  // namespace
}  // namespace clackers::numerics
