#include "clackers/record/reduced_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clackers::record {
namespace {

Curve zigzag(std::size_t n) {
  Curve curve;
  curve.y.resize(2);
  for (std::size_t i = 0; i < n; ++i) {
    curve.t.push_back(double(i));
    curve.y[0].push_back(std::sin(0.7 * double(i)));
    curve.y[1].push_back(i == 4321 ? 9.0 : i == 77 ? -9.0 : 0.0);
  }
  return curve;
}

TEST(ReducedCurve, KeepsAShortCurveWhole) {
  const auto whole = zigzag(12), kept = reduced(whole, 12);
  EXPECT_EQ(kept.t, whole.t);
  EXPECT_EQ(kept.y, whole.y);
  EXPECT_TRUE(reduced(Curve{}).t.empty());
}

TEST(ReducedCurve, KeepsTheExtremesOfEveryCurve) {
  const auto kept = reduced(zigzag(10000), 400);
  EXPECT_LE(kept.t.size(), 400u);
  EXPECT_GE(kept.t.size(), 200u);
  EXPECT_EQ(std::ranges::max(kept.y[1]), 9.0);
  EXPECT_EQ(std::ranges::min(kept.y[1]), -9.0);
  // Each stretch of 100 points has crests and troughs, and a sample within 0.35 of one.
  for (std::size_t i = 0; i + 8 <= kept.t.size(); ++i) {
    const auto from = kept.y[0].begin() + std::ptrdiff_t(i);
    EXPECT_GT(*std::max_element(from, from + 8), 0.939);
    EXPECT_LT(*std::min_element(from, from + 8), -0.939);
  }
}

TEST(ReducedCurve, KeepsPointsTogetherAndInOrder) {
  const auto kept = reduced(zigzag(10000), 400);
  for (std::size_t i = 0; i < kept.t.size(); ++i) {
    EXPECT_EQ(kept.y[0][i], std::sin(0.7 * kept.t[i]));
    EXPECT_TRUE(i == 0 || kept.t[i - 1] < kept.t[i]);
  }
}

}  // namespace
}  // namespace clackers::record
