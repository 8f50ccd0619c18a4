#include "clackers/exact/quantities/quantities.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/closed_form.hpp"

namespace clackers::exact {
namespace {

// (2/pi) times the integral over a period of u2/u2(0) cos(2 n Omega t), by the trapezoidal rule,
// whose error for a continuous periodic function with kinks is X h^2; of the exact motion.
double measured(double odd, int n) {
  const ExactDataPair motion({.sigma = 0.0, .X = odd, .r = 0.5});
  constexpr int pieces = 20000;
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double t = std::numbers::pi * i / pieces;
    sum += motion.at(t, model::Side::left).u[1] * std::cos(2.0 * n * t);
  }
  return std::abs((n == 0 ? 1.0 : 2.0) / pieces * sum / motion.constants().u2);
}

TEST(Harmonics, AreThoseOfTheMotion) {
  for (const double odd : {1.0, 3.0, 9.0, 13.0})
    for (const int n : {0, 1, 2, 4, 5, 9})
      EXPECT_NEAR(harmonic_amplitude(odd, n), measured(odd, n), odd * 1e-7) << odd << " " << n;
}

TEST(Harmonics, AreLargestAtThePeakAndReachTheThresholdAsTheIndicatorsCount) {
  for (const double odd : {1.0, 3.0, 5.0, 21.0, 401.0}) {
    const double peak = harmonic_amplitude(odd, peak_harmonic(odd));
    for (double n = 1.0; n < 2.0 * odd; ++n) EXPECT_LE(harmonic_amplitude(odd, n), peak);
    for (const double threshold : {0.51, 0.1, 0.013}) {
      const double last = indicators(odd, 1.0, 1.0, threshold).highest_harmonic;
      EXPECT_GE(harmonic_amplitude(odd, last), threshold * peak);
      EXPECT_LT(harmonic_amplitude(odd, last + 1.0), threshold * peak);
    }
  }
}

TEST(Harmonics, RefuseNumbersThatAreNoCount) {
  for (const double n : {-1.0, 0.5, 2e15, double(NAN)})
    EXPECT_THROW(harmonic_amplitude(9.0, n), InputError) << n;
}

}  // namespace
}  // namespace clackers::exact
