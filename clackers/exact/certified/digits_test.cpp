#include "clackers/exact/certified/digits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "clackers/base/error.hpp"
#include "clackers/exact/testing/test_oracle.hpp"

namespace clackers::certified {
namespace {

using exact::ExactDataPair;
using exact::PairParameters;
using exact::SynchronizedPair;
using model::Side;

#ifdef CLACKERS_HAS_ARB

using exact::testing_oracle::Real;

std::string code_of(const model::Motion& motion, long long digits) {
  try {
    Digits refused(motion, digits);
    return "accepted";
  } catch (const InputError& error) {
    return std::string(error.code().name());
  }
}

TEST(Digits, AreThoseOfTheFormulaInMpfr) {
  // The oracle has 90 digits; 70 of them are asked, of which the last is rounded.
  for (const auto& p :
       {PairParameters{}, PairParameters{.m1 = 3.0, .k1 = 7.0, .X = 7.0, .eta = 0.7},
        PairParameters{.X = 1.0 / 5.0, .r = 0.5, .t_end = 200.0}}) {
    const SynchronizedPair motion(p);
    const auto oracle = exact::testing_oracle::oracle_of(p);
    Digits digits(motion, 70);
    for (const double t : {0.1, 1.0, 13.37, 19.0}) {
      const auto texts = digits.at(t, Side::right);
      const auto reference = oracle.state(t, Side::right);
      const auto near = [&](const std::string& text, const Real& value) {
        EXPECT_LE(abs(Real(text) / value - 1), Real("5e-70")) << text;
        EXPECT_EQ(text.substr(text.find_first_of("123456789")).find_first_not_of(".0123456789e-+"),
                  std::string::npos);
      };
      for (std::size_t i = 0; i < 2; ++i) {
        near(texts.u[i], reference.u[i]);
        near(texts.v[i], reference.v[i]);
        near(texts.a[i], reference.a[i]);
      }
    }
    for (const long long k : {1LL, 2LL, 6LL}) {
      const auto hit = digits.impact(k);
      EXPECT_LE(abs(Real(hit.t) / oracle.instant(double(k)) - 1), Real("5e-70"));
      EXPECT_EQ(hit.before.u[0], "0");
      const auto around = motion.impact(k);
      EXPECT_DOUBLE_EQ(std::stod(hit.before.v[1]), around.before.v[1]);
      EXPECT_DOUBLE_EQ(std::stod(hit.after.v[0]), around.after.v[0]);
      EXPECT_DOUBLE_EQ(std::stod(hit.impulse), around.impulse);
      EXPECT_DOUBLE_EQ(std::stod(hit.energy_before), around.energy_before);
      EXPECT_DOUBLE_EQ(std::stod(hit.energy_after), around.energy_after);
    }
  }
}

TEST(Digits, OfMoreAndFewerDigitsAreTheSameNumber) {
  const SynchronizedPair motion({.eta = 0.9});
  const auto most = Digits(motion, 1000).at(7.0, Side::right);
  for (const int n : {1, 2, 17, 60, 999}) {
    const auto fewer = Digits(motion, n).at(7.0, Side::right);
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_LE(abs(Real(fewer.u[i]) / Real(most.u[i]) - 1), 5 * pow(Real(10), -n) + Real(1e-88));
  }
  EXPECT_EQ(most.u[0].size(), 1000U + (most.u[0][0] == '-' ? 3 : 2));
}

TEST(Digits, TimesReadBackAsTheDoublesTheyAre) {
  const SynchronizedPair motion({});
  EXPECT_EQ(Digits(motion, 30).time(0.1), "0.100000000000000005551115123126");
  EXPECT_EQ(Digits(motion, 3).time(0.1), "0.10000000000000001");
  EXPECT_EQ(Digits(motion, 3).time(0.0), "0");
  for (const double t : {5e-324, 1e-300, 1.0 / 3.0, 12345.678})
    for (const int n : {1, 17, 800})
      EXPECT_EQ(std::strtod(Digits(motion, n).time(t).c_str(), nullptr), t);
}

TEST(Digits, OfValuesHalfwayBetweenTwoNumbersAreRoundedToEven) {
  // u2(0) = -r A/X = -3 0.25/5 = -0.15 and -0.45, no binary fractions.
  const auto start = [](double A) {
    const SynchronizedPair motion({.A = A, .X = 5.0, .r = 3.0});
    return Digits(motion, 1).at(0.0, Side::left).u[1];
  };
  EXPECT_EQ(start(0.25), "-0.2");
  EXPECT_EQ(start(0.75), "-0.4");
  // Without damping impacts are fractions too: v1 = -A Omega = -0.25, energy (1 + 3) 0.25^2/2 =
  // 0.125, impulse 0.5; k1 = 1/25 of m1 makes Omega 0.2 and v1 = -0.25 again, inexactly.
  const SynchronizedPair undamped({.xi1 = 0.0, .A = 0.25});
  const auto hit = Digits(undamped, 1).impact(1);
  EXPECT_EQ(hit.before.v[0], "-0.2");
  EXPECT_EQ(hit.impulse, "0.5");
  EXPECT_EQ(hit.energy_before, "0.1");
  EXPECT_EQ(Digits(undamped, 2).impact(2).energy_before, "0.12");
  const SynchronizedPair slow({.m1 = 25.0, .k1 = 1.0, .xi1 = 0.0, .A = 1.25, .t_end = 200.0});
  EXPECT_EQ(Digits(slow, 1).impact(3).before.v[0], "-0.2");
  const SynchronizedPair lossy({.m1 = 25.0, .xi1 = 0.0, .A = 1.25, .eta = 0.5, .t_end = 200.0});
  EXPECT_EQ(Digits(lossy, 2).impact(2).before.v[0], "-0.12");
}

TEST(Digits, OfImpactsAreToldForEachSide) {
  const SynchronizedPair motion({.eta = 0.5});
  const double t = motion.impact(2).t;
  Digits digits(motion, 20);
  const auto before = digits.at(t, Side::left), after = digits.at(t, Side::right);
  EXPECT_LT(std::stod(before.v[0]), 0.0);
  EXPECT_DOUBLE_EQ(std::stod(after.v[0]), -0.5 * std::stod(before.v[0]));
  EXPECT_DOUBLE_EQ(std::stod(before.v[0]), motion.at(t, Side::left).v[0]);
}

TEST(Digits, AreToldWhereDoublesUnderflow) {
  const SynchronizedPair motion({.xi1 = 0.9, .t_end = 1e6});
  EXPECT_EQ(motion.at(1e6, Side::right).u[0], 0.0);
  const auto text = Digits(motion, 10).at(1e6, Side::right).u[0];
  EXPECT_NE(text.find("e-390"), std::string::npos) << text;  // exp(-9e5) is 10^-390865
}

class Foreign : public model::Motion {
 public:
  int dof() const override { return 1; }
  double end() const override { return 1.0; }
  void sample(std::span<const double>, Side, model::SampleBuffers) const override {}
  model::Kinematics envelope(double) const override { return {}; }
  model::Kinematics error_bound(double) const override { return {}; }
  long long impact_count(double) const override { return 0; }
  model::MotionImpact impact(long long) const override { return {}; }
};

TEST(Digits, RefuseNumbersOfDigitsOutsideTheirRangeAndOtherMotions) {
  const SynchronizedPair motion({});
  for (const long long n : {-1LL, 0LL, 1001LL}) EXPECT_EQ(code_of(motion, n), "out-of-range");
  EXPECT_EQ(code_of(motion, 1), "accepted");
  EXPECT_EQ(code_of(motion, 1000), "accepted");
  EXPECT_EQ(code_of(Foreign(), 20), "no-enclosure");
}

#else

TEST(Digits, AreRefusedInWordsWithoutArb) {
  const SynchronizedPair motion({});
  try {
    Digits digits(motion, 20);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code().name(), "needs-arb");
    EXPECT_NE(std::string(error.what()).find("libflint-arb-dev"), std::string::npos);
  }
}

#endif

}  // namespace
}  // namespace clackers::certified
