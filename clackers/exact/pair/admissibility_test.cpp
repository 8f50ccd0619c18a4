#include "clackers/exact/pair/admissibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/closed_form.hpp"

namespace clackers::exact {
namespace {

using std::numbers::pi_v;
constexpr long double long_pi = pi_v<long double>;

// -1/min of sin(X theta)/(X sin theta) by looking everywhere: 40 points a half wave of the fast
// mass, then the lowest of them refined by golden section.
double minimised_r_star(double X) {
  const auto ratio = [X](long double theta) { return std::sin(X * theta) / (X * std::sin(theta)); };
  const long double step = long_pi / (40.0L * X);
  long double best = step;
  for (long double theta = step; theta <= long_pi / 2; theta += step)
    if (ratio(theta) < ratio(best)) best = theta;
  long double low = best - step, high = std::min(best + step, long_pi / 2 + step);
  for (int i = 0; i < 80; ++i) {
    const long double a = low + 0.381966L * (high - low), b = low + 0.618034L * (high - low);
    (ratio(a) < ratio(b) ? high : low) = ratio(a) < ratio(b) ? b : a;
  }
  return static_cast<double>(-1.0L / ratio((low + high) / 2));
}

TEST(Admissibility, LimitsAreTheListedOnesToAllPrintedDigits) {
  EXPECT_EQ(r_star(1.0), INFINITY);
  EXPECT_EQ(r_star(3.0), 3.0);
  EXPECT_EQ(r_star(5.0), 4.0);
  for (const auto& [X, digits] : {std::pair{7.0, "4.2915026"},
                                  {9.0, "4.4136778"},
                                  {13.0, "4.5120427"},
                                  {21.0, "4.5682661"},
                                  {41.0, "4.5941273"},
                                  {401.0, "4.6032425"}}) {
    char text[32];
    std::snprintf(text, sizeof text, "%.7f", r_star(X));
    EXPECT_STREQ(text, digits) << "X = " << X;
  }
  // r_infinity = sqrt(1 + x^2) with tan x = x; r* falls short of it by order 1/X^2.
  EXPECT_NEAR(r_star(999999999.0), 4.60333884875, 5e-12);
}

TEST(Admissibility, LimitsAreTheMinimaThatDefineThem) {
  // Long double: 1e-18 for the ratio, which is flat at the minimum.
  for (double X = 3.0; X < 60.0; X += 2.0)
    EXPECT_NEAR(r_star(X), minimised_r_star(X), 1e-14) << "X = " << X;
  EXPECT_NEAR(r_star(1001.0), minimised_r_star(1001.0), 1e-14);
}

TEST(Admissibility, LimitsRiseStrictly) {
  double before = 0.0;
  for (double X = 3.0; X < 4000.0; X += 2.0) {
    EXPECT_GT(r_star(X), before) << "X = " << X;
    before = r_star(X);
  }
  EXPECT_LT(before, 4.60333884875);
}

// The first time the gap closes, by walking in steps of 1/400 of the fast half wave and bisecting.
long double searched_contact(long double X, long double r, long double s) {
  const auto gap = [&](long double angle) {
    return std::cos(angle) + s * r / X * std::cos(X * angle);
  };
  if (gap(0.0L) <= 0.0L) return 0.0L;
  const long double step = long_pi / (400.0L * X);
  long double from = 0.0L;
  while (gap(from + step) > 0.0L) from += step;
  long double to = from + step;
  for (int i = 0; i < 100; ++i) {
    const long double middle = (from + to) / 2;
    (gap(middle) > 0.0L ? from : to) = middle;
  }
  return to;
}

TEST(Admissibility, BeyondTheLimitTheFirstContactIsWhereASearchFindsIt) {
  for (const double X : {3.0, 5.0, 7.0, 9.0, 11.0, 21.0, 23.0, 401.0})
    for (const double factor : {1.00001, 1.01, 1.2, 1.9, 3.0, 10.0, 100.0}) {
      const double r = factor * r_star(X);
      const long double s = std::fmod(X, 4.0) == 1.0 ? 1.0L : -1.0L;
      // The gap is zero to 1e-16 relative at the angle; its slope is of order sqrt(factor - 1).
      EXPECT_NEAR(first_contact_angle(X, r), double(searched_contact(X, r, s)), 1e-12)
          << "X = " << X << " factor " << factor;
      if (X == 3.0) {
        EXPECT_EQ(first_contact_angle(X, r), 0.0);
      }
    }
}

TEST(Admissibility, AtTheLimitTheGrazeIsAtTheMinimum) {
  EXPECT_EQ(first_contact_angle(3.0, 3.0), 0.0);
  // X = 5: sin^2 of pi/2 - angle is 5/8. A double root: half the digits.
  EXPECT_NEAR(first_contact_angle(5.0, 4.0), std::acos(std::sqrt(0.625)), 3e-8);
  // X = 9: gap and slope vanish there.
  const double before = std::numbers::pi / 2 - first_contact_angle(9.0, r_star(9.0));
  EXPECT_NEAR(9.0 * std::sin(before) + r_star(9.0) * std::sin(9.0 * before), 0.0, 1e-14);
  EXPECT_NEAR(std::cos(before) + r_star(9.0) * std::cos(9.0 * before), 0.0, 1e-6);
}

std::string refusal(const PairParameters& p) {
  try {
    SynchronizedPair pair(p);
    return "accepted";
  } catch (const InputError& error) {
    return std::string(error.what()) + " [" + std::string(error.code().name()) + "]";
  }
}

TEST(Admissibility, IsDecidedToTheLastBitOfTheMassRatio) {
  for (const double X : {3.0, 5.0}) {
    const double limit = r_star(X);
    EXPECT_EQ(refusal({.X = X, .r = std::nextafter(limit, 0.0)}), "accepted");
    EXPECT_NE(refusal({.X = X, .r = limit}).find("graze"), std::string::npos);
    EXPECT_EQ(refusal({.X = X, .r = std::nextafter(limit, 9.0)}).find("graze"), std::string::npos);
    EXPECT_NE(refusal({.X = X, .r = std::nextafter(limit, 9.0)}).find("[not-admissible]"),
              std::string::npos);
  }
  // Irrational limits: one neighbour is inside, the other outside.
  EXPECT_EQ(refusal({.X = 9.0, .r = std::nextafter(r_star(9.0), 0.0)}), "accepted");
  EXPECT_NE(refusal({.X = 9.0, .r = std::nextafter(r_star(9.0), 9.0)}), "accepted");
  EXPECT_EQ(refusal({.X = 1.0, .r = 1e60}), "accepted");
}

TEST(Admissibility, RefusalSaysHowFarWhenWhereAndWhatToChange) {
  EXPECT_EQ(
      refusal({.r = 5.0}),
      "synchronized-pair: r = 5; allowed: 0 < r < r*(9) = 4.413677812. The value is 1.13284 times "
      "it: the masses would touch at t = 1.01421 s, where u1 = u2 = 0.50319 m, away from "
      "equilibrium, and the closed form would not hold. Take r below the limit, or X = 1, which "
      "takes every r. [not-admissible]");
  EXPECT_EQ(
      refusal({.X = 3.0, .r = 3.0}),
      "synchronized-pair: r = 3; allowed: 0 < r < r*(3) = 3. The value is exactly on it: the "
      "masses would graze at t = 0 s, where u1 = u2 = 1 m, away from equilibrium, so that no "
      "computation can distinguish contact from none. Take r below the limit, or X = 1, which takes "
      "every r. [not-admissible]");
  EXPECT_NE(refusal({.X = 3.0, .r = 4.0}).find("touch or overlap already at t = 0 s"),
            std::string::npos);
}

TEST(Admissibility, ExchangedRolesTurnTheLimitOver) {
  EXPECT_EQ(refusal({.X = 1.0 / 9.0, .r = 0.23}), "accepted");
  // The slow mass is the lower one: the same motion upside down and nine times slower.
  EXPECT_EQ(
      refusal({.X = 1.0 / 9.0, .r = 0.2}),
      "synchronized-pair: r = 0.2; allowed: r > 1/r*(9) = 0.2265684181. The value is 0.882736 "
      "times it: the masses would touch at t = 9.12792 s, where u1 = u2 = -0.603695 m, away from "
      "equilibrium, and the closed form would not hold. Take r above the limit, or X = 1, which "
      "takes every r. [not-admissible]");
  EXPECT_NE(refusal({.X = 1.0 / 3.0, .r = 1.0 / 3.0}), "accepted");
}

TEST(Admissibility, HoldsForExactDataToo) {
  EXPECT_NO_THROW(ExactDataPair({.r = 4.25}));
  EXPECT_THROW(ExactDataPair({.r = 4.5}), InputError);
  EXPECT_THROW(ExactDataPair({.X = 5.0, .r = 4.0}), InputError);
}

TEST(Admissibility, MarginIsTheSmallestGapRelativeToTheSlowMass) {
  EXPECT_DOUBLE_EQ(admissibility_margin({9.0, false}, 3.0), 1.0 - 3.0 / r_star(9.0));
  EXPECT_DOUBLE_EQ(admissibility_margin({9.0, true}, 0.5), 1.0 - 2.0 / r_star(9.0));
  EXPECT_EQ(admissibility_margin({1.0, false}, 0.5), 1.5);
  // Measured on the motion itself.
  for (const auto& p :
       {PairParameters{.X = 7.0, .r = 2.0}, PairParameters{.X = 0.2, .r = 0.75, .t_end = 90.0}}) {
    const SynchronizedPair pair(p);
    const bool exchanged = p.X < 1.0;
    double smallest = 9.0;
    for (int i = 0; i <= 20000; ++i) {
      const auto now = pair.at(pair.constants().period * (0.5 + i / 20000.0), model::Side::right);
      const double slow = std::abs(now.u[exchanged ? 1 : 0]);
      if (slow > 1e-3) smallest = std::min(smallest, (now.u[0] - now.u[1]) / slow);
    }
    // The parabola at the minimum is met to (X pi / 20000)^2.
    EXPECT_NEAR(smallest, pair.constants().margin, 1e-5);
  }
}

}  // namespace
}  // namespace clackers::exact
