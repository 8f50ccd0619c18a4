// The responses of the named cases against the equations that the paper prints for them, written
// with its sign function and its unreduced phases, in long double. Of Eq. (27), (30), (32) and (36),
// one formula for longer and longer intervals, the last is Eq. (26).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/cases/case.hpp"

namespace clackers::cases {
namespace {

using model::Side;

constexpr long double pi = std::numbers::pi_v<long double>;

long double sgn(long double x) { return x < 0 ? -1.0L : x > 0 ? 1.0L : 0.0L; }  // Eq. (6)

// Steps that meet no impact: u bends there and v jumps.
std::vector<double> times(double end) {
  std::vector<double> t;
  for (int i = 0; i < 97; ++i) t.push_back(end * (i + 0.321) / 97.5);
  return t;
}

// u and its formula: half a unit of the envelope for the double, one for the formula, and its phase
// with some roundings of 2^-64.
void expect_displacement(const Case& test_case, double t, int mass, long double formula,
                         long double envelope, long double phase) {
  const auto u = test_case.motion->at(t, Side::right).u[mass];
  EXPECT_NEAR(u, double(formula),
              double(envelope * (1.5L * 0x1p-52L + 8.0L * phase * 0x1p-64L) + 5e-324L))
      << test_case.entry->name << " t = " << t << " mass " << mass + 1;
}

// Eq. (26); d2 = u2(0).
void expect_eq26(const Case& test_case, long double X, long double omega, long double xi1,
                 long double d2) {
  for (const double t : times(test_case.motion->end())) {
    const long double e = std::exp(-xi1 * t), slow = std::cos(omega * t);
    expect_displacement(test_case, t, 0, sgn(slow) * slow * e, e, omega * t);
    expect_displacement(test_case, t, 1, d2 * sgn(slow) * std::cos(X * omega * t) * e, -d2 * e,
                        X * omega * t);
  }
}

TEST(PaperResponses, OfTheFreeMassIsEq4) {
  const auto test_case = make("sdof");
  for (const double t : times(20.0)) {
    const long double e = std::exp(-0.05L * t), phase = std::sqrt(0.9975L) * t;
    expect_displacement(test_case, t, 0, std::cos(phase) * e, e, phase);
  }
}

TEST(PaperResponses, AboveAStopIsEq5) {
  const auto test_case = make("stop");
  for (const double t : times(20.0)) {
    const long double e = std::exp(-0.05L * t), phase = std::sqrt(0.9975L) * t;
    expect_displacement(test_case, t, 0, sgn(std::cos(phase)) * std::cos(phase) * e, e, phase);
  }
}

TEST(PaperResponses, OfTheSymmetricPairIsEq8) {
  expect_eq26(make("symmetric-pair"), 1.0L, std::sqrt(0.9975L), 0.05L, -1.0L);
}

TEST(PaperResponses, OfOneParameterIsEq20) {
  for (const double N : {0.0, 1.0, 2.0, 5.0, 20.0}) {
    const long double X = 4.0L * N + 1.0L;
    expect_eq26(make("one-parameter", {{"N", N}}), X, std::sqrt(0.9975L), 0.05L, -3.0L / X);
  }
}

TEST(PaperResponses, OfTwoParametersIsEq22) {
  for (const double xi1 : {0.0, 0.1, 0.25, 0.9}) {
    const long double omega = std::sqrt(1.0L - static_cast<long double>(xi1) * xi1);
    expect_eq26(make("two-parameter", {{"N", 5}, {"xi1", xi1}}), 21.0L, omega, xi1, -3.0L / 21.0L);
  }
}

TEST(PaperResponses, OfThreeParametersIsEq26) {
  for (const double a_t : {0.5, 1.2, 20.0}) {
    const auto test_case = make("three-parameter", {{"N", 2}, {"xi1", 0.125}, {"a_t", a_t}});
    expect_eq26(test_case, 9.0L, std::sqrt(1.0L - 0.015625L), 0.125L, -3.0L / 9.0L);
    EXPECT_EQ(test_case.motion->end(), 20.0 * a_t);
  }
}

// The instants of section 2.3. Doubles beside them are rounded by half a unit.
TEST(PaperResponses, CollideAtEq28AndEq34InEquilibrium) {
  for (const double N : {0.0, 1.0, 5.0})
    for (const double xi1 : {0.0, 0.1, 0.75}) {
      const auto test_case = make("three-parameter", {{"N", N}, {"xi1", xi1}});
      const long double omega = std::sqrt(1.0L - static_cast<long double>(xi1) * xi1);
      const auto first = test_case.motion->impact(1), second = test_case.motion->impact(2);
      EXPECT_DOUBLE_EQ(first.t, double(pi / (2.0L * omega)));
      EXPECT_DOUBLE_EQ(second.t, double(3.0L * pi / (2.0L * omega)));
      // Eq. (29) and (35).
      for (const auto& hit : {first, second})
        for (const auto& limit : {hit.before, hit.after}) EXPECT_EQ(limit.u, Eigen::Vector2d(0, 0));
    }
}

// Eq. (31), (33), (37): nothing collides from t_C1 to t_C* = pi/Omega, from there to t_C2, and from
// t_C2 to t_C*** = 2 pi/Omega, Eq. (38).
TEST(PaperResponses, StayApartBetweenTheImpacts) {
  for (const double N : {0.0, 1.0, 5.0})
    for (const double xi1 : {0.0, 0.1, 0.75}) {
      SCOPED_TRACE(testing::Message() << "N = " << N << " xi1 = " << xi1);
      const auto test_case = make("three-parameter", {{"N", N}, {"xi1", xi1}});
      const double half = std::numbers::pi / std::sqrt((1.0 - xi1) * (1.0 + xi1));
      // Beginning, end, impacts so far.
      for (const auto& [from, to, impacts] :
           {std::tuple{0.0, 0.5, 0}, {0.5, 1.0, 1}, {1.0, 1.5, 1}, {1.5, 2.0, 2}})
        for (double part = 0.001; part < 1.0; part += 0.001) {
          const double t = half * (from + part * (to - from));
          const auto now = test_case.motion->at(t, Side::right);
          EXPECT_GT(now.u[0], now.u[1]) << "t = " << t;
          EXPECT_EQ(test_case.motion->impact_count(t), impacts) << "t = " << t;
        }
    }
}

// Figure 12: at Eq. (38) and its multiples the pair is where it would be without impacts.
TEST(PaperResponses, AtMultiplesOfEq38AreThoseWithoutImpacts) {
  for (const double N : {0.0, 1.0, 5.0})
    for (const double xi1 : {0.0, 0.1}) {
      const auto test_case = make("three-parameter", {{"N", N}, {"xi1", xi1}, {"a_t", 2.0}});
      const long double omega = std::sqrt(1.0L - static_cast<long double>(xi1) * xi1);
      for (int j = 1; j <= 6; ++j) {
        const double t = double(2.0L * pi * j / omega);
        const auto now = test_case.motion->at(t, Side::right);
        const auto envelope = test_case.motion->envelope(t);
        for (int i = 0; i < 2; ++i) {
          // Eq. (27) and its derivative.
          const long double p = i == 0 ? 1.0L : 4.0L * N + 1.0L, b = i == 0 ? 1.0L : -3.0L / p;
          const long double e = b * std::exp(-xi1 * static_cast<long double>(t)), w = p * omega;
          const double bound = double(1.5L * 0x1p-52L + 8.0L * w * t * 0x1p-64L);
          EXPECT_NEAR(now.u[i], double(e * std::cos(w * t)), bound * envelope.u[i]);
          EXPECT_NEAR(now.v[i], double(-e * (xi1 * std::cos(w * t) + w * std::sin(w * t))),
                      bound * envelope.v[i]);
        }
        EXPECT_EQ(test_case.motion->impact_count(t), 2 * j);
      }
    }
}

}  // namespace
}  // namespace clackers::cases
