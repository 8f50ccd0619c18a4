#include "clackers/exact/quantities/quantities.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/base/error.hpp"

namespace clackers::exact {
namespace {

// |a_n| of u2/d2 = cos(X theta), theta in [-pi/2, pi/2) repeated, at frequency 2n: Simpson's rule.
double harmonic(double X, int n) {
  const int panels = 1000;
  double sum = 0.0;
  for (int i = 0; i <= panels; ++i) {
    const double theta = std::numbers::pi * (double(i) / panels - 0.5);
    const double weight = i == 0 || i == panels ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * std::cos(X * theta) * std::cos(2.0 * n * theta);
  }
  return std::abs(2.0 / std::numbers::pi * sum * std::numbers::pi / panels / 3.0);
}

// The highest n that reaches the threshold, by measuring the spectrum.
int measured(double X, double threshold) {
  const int peak = X == 1.0 ? 1 : int(X - 1.0) / 2;
  int highest = 0;
  for (int n = 1; n < 120; ++n)
    if (harmonic(X, n) >= threshold * harmonic(X, peak)) highest = n;
  return highest;
}

TEST(Indicators, HighestHarmonicIsTheOneASpectrumShows) {
  for (const double X : {1.0, 3.0, 5.0, 9.0, 11.0, 21.0})
    for (const double threshold : {0.9, 0.51, 0.1, 0.03, 0.012})
      EXPECT_EQ(indicators(X, 1.0, 20.0, threshold).highest_harmonic, measured(X, threshold))
          << "X = " << X << " threshold " << threshold;
}

TEST(Indicators, FollowEquations10And11And23) {
  // N = 2 of the paper: X = 9, sqrt(81 + 17/0.1)/2 = 7.92.
  const double omega = std::sqrt(0.9975);
  const auto found = indicators(9.0, omega, 20.0, 0.1);
  EXPECT_EQ(found.stiffness_ratio, 9.0);
  EXPECT_EQ(found.highest_harmonic, 7.0);
  EXPECT_DOUBLE_EQ(found.longest_period, std::numbers::pi / omega);
  EXPECT_DOUBLE_EQ(found.shortest_period, std::numbers::pi / omega / 7.0);
  EXPECT_DOUBLE_EQ(found.oscillations, 20.0 * 7.0 * omega / std::numbers::pi);
  EXPECT_EQ(found.threshold, 0.1);
  EXPECT_TRUE(found.bound_holds);
}

TEST(Indicators, BoundHoldsExactlyAboveTheThresholdOfTheProof) {
  for (const double X : {3.0, 5.0, 9.0, 401.0, 400001.0}) {
    const double limit = (2.0 * X - 1.0) / ((3.0 * X + 2.0) * (X + 2.0));
    EXPECT_TRUE(indicators(X, 1.0, 20.0, limit * (1.0 + 1e-15)).bound_holds) << X;
    EXPECT_FALSE(indicators(X, 1.0, 20.0, limit * (1.0 - 1e-15)).bound_holds) << X;
  }
  // The double 0.2 is a little above 1/5.
  EXPECT_TRUE(indicators(1.0, 1.0, 20.0, 0.2).bound_holds);
  EXPECT_FALSE(indicators(1.0, 1.0, 20.0, std::nextafter(0.2, 0.0)).bound_holds);
  // With the default threshold it holds for every odd X but 1.
  EXPECT_FALSE(indicators(1.0, 1.0, 20.0, 0.1).bound_holds);
  for (double X = 3.0; X < 300.0; X += 2.0) EXPECT_TRUE(indicators(X, 1.0, 20.0, 0.1).bound_holds);
}

TEST(Indicators, AHarmonicIsCountedToTheLastBitOfTheThreshold) {
  // X = 3: n = 2 is 5/7 of the peak at n = 1. One neighbour of that quotient lies below, one above.
  const double quotient = 5.0 / 7.0;
  const bool above = std::fma(quotient, 7.0, -5.0) > 0.0;
  const double below = above ? std::nextafter(quotient, 0.0) : quotient;
  EXPECT_EQ(indicators(3.0, 1.0, 1.0, below).highest_harmonic, 2.0);
  EXPECT_EQ(indicators(3.0, 1.0, 1.0, std::nextafter(below, 1.0)).highest_harmonic, 1.0);
}

TEST(Indicators, RefuseThresholdsThatTooManyHarmonicsReach) {
  for (const double X : {1.0, 9.0, 999999999.0})
    for (const double threshold : {1e-300, 1e-60, 1e-30}) {
      SCOPED_TRACE(testing::Message() << X << " " << threshold);
      std::string text;
      try {
        indicators(X, 1.0, 20.0, threshold);
      } catch (const InputError& error) {
        text = error.what();
      }
      EXPECT_NE(text.find("--threshold"), std::string::npos) << text;
      // What the message allows is accepted.
      const auto at = text.find("allowed: ");
      ASSERT_NE(at, std::string::npos);
      const double allowed = std::stod(text.substr(at + 9));
      const double n = indicators(X, 1.0, 20.0, allowed).highest_harmonic;
      EXPECT_GT(n, 4e14);
      EXPECT_LE(n, 5e14);
    }
}

TEST(Indicators, RefuseThresholdsThatAreNoFraction) {
  for (const double threshold : {0.0, 1.0, -0.1, 2.0, double(NAN), double(INFINITY)})
    EXPECT_THROW(indicators(9.0, 1.0, 20.0, threshold), InputError) << threshold;
}

}  // namespace
}  // namespace clackers::exact
