#ifdef CLACKERS_HAS_ARB

#include "clackers/exact/certified/digits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>

#include "clackers/base/error.hpp"

namespace clackers::certified {
namespace {

std::string text(const Ball& value, int n, const std::optional<Fraction>& fraction = {}) {
  return decimals(value, n, fraction).value_or("undecided");
}

// The value with a radius of 2^exponent, which still holds it.
Ball widened(Ball value, long exponent) {
  arb_add_error_2exp_si(value.get(), exponent);
  return value;
}

TEST(Decimals, AreThoseOfTheCLibraryForDoubles) {
  // printf rounds the exact value of a double, half to even, as this does.
  constexpr unsigned seed = 20260501;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> exponent(-12.0, 42.0), sign(-1.0, 1.0);
  std::uniform_int_distribution<int> digits(1, 40);
  for (int i = 0; i < 2000; ++i) {
    const double decades = (i % 2 == 0 ? 1.0 : 7.0) * exponent(random);
    const double value = std::copysign(std::pow(10.0, decades), sign(random));
    const int n = digits(random);
    char expected[512];
    std::snprintf(expected, sizeof expected, "%.*e", n - 1, value);
    const int e = std::atoi(std::strchr(expected, 'e') + 1);
    if (e >= -5 && e < n) std::snprintf(expected, sizeof expected, "%.*f", n - 1 - e, value);
    EXPECT_EQ(text(value, n), expected) << "seed " << seed;
  }
}

TEST(Decimals, AreWrittenWithoutAnExponentWhereThatIsShort) {
  EXPECT_EQ(text(0.0, 5), "0");
  EXPECT_EQ(text(1.0, 1), "1");
  EXPECT_EQ(text(1.0, 4), "1.000");
  EXPECT_EQ(text(-0.5, 3), "-0.500");
  EXPECT_EQ(text(1234.0, 4), "1234");
  EXPECT_EQ(text(1234.0, 3), "1.23e+03");
  EXPECT_EQ(text(1234.0, 6), "1234.00");
  EXPECT_EQ(text(0x1p-10, 4), "0.0009766");
  EXPECT_EQ(text(1e-5, 2), "0.000010");
  EXPECT_EQ(text(1e-6, 1), "1e-06");
  EXPECT_EQ(text(1e-6, 2), "1.0e-06");
  EXPECT_EQ(text(-1e200, 3), "-1.00e+200");
}

TEST(Decimals, CarryIntoANewDigit) {
  EXPECT_EQ(text(9.96, 2), "10");
  EXPECT_EQ(text(9.94, 2), "9.9");
  EXPECT_EQ(text(99999.0, 3), "1.00e+05");
  EXPECT_EQ(text(0.999999, 3), "1.00");
  EXPECT_EQ(text(0.9994, 3), "0.999");
  // From both sides of a power of ten, and on it without knowing.
  EXPECT_EQ(text(std::nextafter(1000.0, 0.0), 10), "1000.000000");
  EXPECT_EQ(text(std::nextafter(1000.0, 2000.0), 10), "1000.000000");
  EXPECT_EQ(text(widened(1000.0, -60), 10), "1000.000000");
}

TEST(Decimals, HalvesGoToTheEvenDigit) {
  EXPECT_EQ(text(0.125, 2), "0.12");
  EXPECT_EQ(text(0.375, 2), "0.38");
  EXPECT_EQ(text(2.5, 1), "2");
  EXPECT_EQ(text(-3.5, 1), "-4");
  EXPECT_EQ(text(25.0, 1), "2e+01");
  EXPECT_EQ(text(9.5, 1), "1e+01");
  EXPECT_EQ(text(8.5, 1), "8");
}

TEST(Decimals, OfABallThatHoldsTwoRoundingsAreUndecided) {
  EXPECT_EQ(text(widened(0.125, -40), 2), "undecided");
  EXPECT_EQ(text(widened(0.125, -40), 3), "0.125");
  EXPECT_EQ(text(widened(0.126, -40), 2), "0.13");
  EXPECT_EQ(text(widened(0.0, -1000), 2), "undecided");
  EXPECT_EQ(text(widened(1.0, -3), 3), "undecided");
}

TEST(Decimals, OfAFractionInANarrowBallHalvesAreProved) {
  // 3/20 is no binary fraction, so no ball is exact. Its square is 9/400, 400 < 2^9.
  const WorkingBits scope(200);
  const Ball value = Ball(3.0) / 20.0;
  EXPECT_EQ(text(value, 1), "undecided");
  EXPECT_EQ(text(value, 1, Fraction{9.0}), "0.2");
  EXPECT_EQ(text(Ball(-9.0) / 20.0, 1, Fraction{9.0}), "-0.4");
  // Too wide a ball for a fraction with so large a denominator.
  EXPECT_EQ(text(value, 1, Fraction{400.0}), "undecided");
  EXPECT_EQ(text(widened(value, -20), 1, Fraction{9.0}), "undecided");
  // 250/3 * 3: exactly halfway between 2e2 and 3e2, with a divided power of ten.
  EXPECT_EQ(text(Ball(250.0) / 3.0 * 3.0, 1, Fraction{4.0}), "2e+02");
  // There the power of ten stands in the denominator and asks for a narrower ball.
  EXPECT_EQ(text(widened(250.0, -22), 1, Fraction{4.0}), "undecided");
  EXPECT_EQ(text(widened(250.0, -32), 1, Fraction{4.0}), "2e+02");
  // What is no half is not made one.
  EXPECT_EQ(text(value, 3, Fraction{9.0}), "0.150");
}

TEST(Decimals, OfExponentsBeyondDoublesAreWritten) {
  EXPECT_EQ(text(scaled(Ball(1.0), -100000), 5), "1.0010e-30103");
  EXPECT_EQ(text(scaled(Ball(1.0), 100000), 5), "9.9900e+30102");
}

TEST(Decimals, OfExponentsBeyondCountingAreRefused) {
  try {
    text(exp(-scaled(Ball(1.0), 60)), 5);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("10^(-5.01e+17)"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace clackers::certified

#endif
