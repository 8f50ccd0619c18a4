#include "clackers/numerics/line_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "clackers/base/error.hpp"

namespace clackers::numerics {
namespace {

TEST(LineFit, GivesBackAnExactLine) {
  const std::vector<double> x{-1.0, 0.5, 2.0, 7.0};
  std::vector<double> y;
  for (const double value : x) y.push_back(3.0 - 2.0 * value);
  const auto fit = fit_line(x, y);
  EXPECT_DOUBLE_EQ(fit.slope, -2.0);
  EXPECT_DOUBLE_EQ(fit.intercept, 3.0);
  EXPECT_DOUBLE_EQ(fit.at(10.0), -17.0);
  // Rounding alone: four residuals of at most 2 ulp of 11.
  EXPECT_LT(fit.slope_spread, 1e-14);
  EXPECT_LT(fit.largest_above + fit.largest_below, 1e-14);
}

// Worked by hand: x = 0 1 2 3, y = 1 0 3 4; means 1.5 and 2, Sxx = 5, Sxy = 6, slope 1.2, intercept
// 0.2; residuals 0.8 -1.4 0.4 0.2, squares 2.8; standard error sqrt(2.8 / 2 / 5).
// Student's t of two degrees of freedom is (2p-1) sqrt(2 / (4 p (1-p))), p = 0.975.
TEST(LineFit, AgreesWithACaseWorkedByHand) {
  const std::vector<double> x{0.0, 1.0, 2.0, 3.0}, y{1.0, 0.0, 3.0, 4.0};
  const auto fit = fit_line(x, y);
  EXPECT_NEAR(fit.slope, 1.2, 1e-15);
  EXPECT_NEAR(fit.intercept, 0.2, 1e-15);
  EXPECT_NEAR(fit.slope_error, std::sqrt(0.28), 1e-15);
  EXPECT_NEAR(fit.slope_spread, 0.95 * std::sqrt(2.0 / 0.0975) * std::sqrt(0.28), 1e-13);
  EXPECT_NEAR(fit.largest_above, 0.8, 1e-15);
  EXPECT_NEAR(fit.largest_below, 1.4, 1e-15);
}

TEST(LineFit, LosesNoDigitsFarFromTheOrigin) {
  std::vector<double> x, y;
  for (int i = 0; i < 8; ++i) {
    x.push_back(1e8 + i);
    y.push_back(1e6 + (i % 2 == 0 ? 0.25 : -0.25));
  }
  const auto fit = fit_line(x, y);
  // Sxy = sum of (i - 3.5) * (+-1/4) = -1, Sxx = 42.
  EXPECT_NEAR(fit.slope, -1.0 / 42.0, 1e-12);
  EXPECT_NEAR(fit.largest_above, 0.25 + 2.5 / 42.0, 1e-9);
}

TEST(LineFit, ItsIntervalHoldsTheTrueSlopeNineteenTimesInTwenty) {
  std::mt19937 random(20250101);
  std::normal_distribution<double> noise(0.0, 0.3);
  const int trials = 4000;
  int inside = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> x, y;
    for (int i = 0; i < 6; ++i) {
      x.push_back(0.7 * i);
      y.push_back(1.5 * x.back() + noise(random));
    }
    const auto fit = fit_line(x, y);
    inside += std::abs(fit.slope - 1.5) <= fit.slope_spread;
  }
  // Binomial: standard deviation sqrt(0.95 * 0.05 / 4000) = 0.0034; four of them.
  EXPECT_NEAR(double(inside) / trials, 0.95, 0.014);
}

TEST(LineFit, TwoPointsLeaveTheSpreadUnknown) {
  const std::vector<double> x{0.0, 1.0}, y{0.0, 5.0};
  EXPECT_DOUBLE_EQ(fit_line(x, y).slope, 5.0);
  EXPECT_TRUE(std::isinf(fit_line(x, y).slope_spread));
}

TEST(LineFit, RefusesWhatCarriesNoLine) {
  const std::vector<double> one{1.0}, two{1.0, 2.0}, same{1.0, 1.0}, bad{1.0, NAN};
  EXPECT_THROW(fit_line(one, one), InputError);
  EXPECT_THROW(fit_line(two, one), InputError);
  EXPECT_THROW(fit_line(same, two), InputError);
  EXPECT_THROW(fit_line(bad, two), InputError);
  EXPECT_THROW(fit_line(two, bad), InputError);
}

// Any table of Student's t, two-sided 95 %.
TEST(StudentT, AgreesWithTheTables) {
  EXPECT_NEAR(student_t95(1), 12.7062, 5e-5);
  EXPECT_NEAR(student_t95(2), 4.3027, 5e-5);
  EXPECT_NEAR(student_t95(10), 2.2281, 5e-5);
  EXPECT_NEAR(student_t95(1000), 1.9623, 5e-5);
  EXPECT_THROW(student_t95(0), InputError);
}

}  // namespace
}  // namespace clackers::numerics
