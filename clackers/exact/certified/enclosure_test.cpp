#ifdef CLACKERS_HAS_ARB

#include "clackers/exact/certified/enclosure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clackers/exact/testing/test_oracle.hpp"

namespace clackers::certified {
namespace {

using exact::ExactDataPair;
using exact::FreeMass;
using exact::RigidStop;
using exact::SynchronizedPair;
using exact::testing_oracle::Box;
using exact::testing_oracle::trials;
using model::Side;

constexpr long bits = 128;

// |ball - value| is certainly at most `bound`.
bool is_within(const Ball& ball, double value, double bound) {
  const WorkingBits scope(2 * bits);
  return !(abs(ball - value) > Ball(bound)) && abs(ball - value).middle() <= bound;
}

// The double results against the balls: the motion's own bound at a time; 0.51 units of 2^-52 of
// each value itself, and one subnormal spacing, at an impact.
double own_bound(double value) { return std::ldexp(std::abs(value) * 0.52, -52) + 5e-324; }

void expect_enclosed(const exact::ClosedForm& motion, double t, Side side) {
  PairEnclosure enclosure{Inputs(motion)};
  const auto reference = enclosure.at(t, side, bits);
  const auto now = motion.at(t, side);
  const auto bound = motion.error_bound(t);
  ASSERT_EQ(reference.u.size(), std::size_t(motion.dof()));
  for (std::size_t i = 0; i < reference.u.size(); ++i) {
    const auto m = static_cast<Eigen::Index>(i);
    EXPECT_TRUE(is_within(reference.u[i], now.u[m], bound.u[m])) << "t = " << t;
    EXPECT_TRUE(is_within(reference.v[i], now.v[m], bound.v[m])) << "t = " << t;
    EXPECT_TRUE(is_within(reference.a[i], now.a[m], bound.a[m])) << "t = " << t;
    for (const auto* value : {&reference.u[i], &reference.v[i], &reference.a[i]})
      EXPECT_TRUE(value->is_zero() || value->accuracy() >= bits);
  }
  EXPECT_EQ(enclosure.impact_count(t), motion.impact_count(t));
}

void expect_impact_enclosed(const exact::ClosedForm& motion, long long k) {
  PairEnclosure enclosure{Inputs(motion)};
  const auto reference = enclosure.impact(k, bits);
  const auto hit = motion.impact(k);
  EXPECT_TRUE(Ball(hit.when.lo) < reference.t && reference.t < Ball(hit.when.hi));
  EXPECT_EQ(reference.t.middle(), hit.t);
  EXPECT_GE(reference.t.accuracy(), bits);
  const auto near = [&](const Ball& ball, double value) {
    EXPECT_TRUE(is_within(ball, value, own_bound(value))) << "k = " << k << " value " << value;
  };
  for (std::size_t i = 0; i < reference.before.v.size(); ++i) {
    const auto m = static_cast<Eigen::Index>(i);
    EXPECT_TRUE(reference.before.u[i].is_zero() && reference.after.u[i].is_zero());
    near(reference.before.v[i], hit.before.v[m]);
    near(reference.before.a[i], hit.before.a[m]);
    near(reference.after.v[i], hit.after.v[m]);
    near(reference.after.a[i], hit.after.a[m]);
  }
  near(reference.impulse, hit.impulse);
  near(reference.energy_before, hit.energy_before);
  near(reference.energy_after, hit.energy_after);
}

void expect_all_enclosed(const exact::ClosedForm& motion, Box& box) {
  const double end = motion.end();
  expect_enclosed(motion, 0.0, Side::left);
  for (int i = 0; i < 3; ++i)
    expect_enclosed(motion, end * std::min(1.0, box.decades(-9.0, 0.0)), Side::right);
  expect_enclosed(motion, end, Side::right);
  const auto count = motion.impact_count(end);
  for (const auto k : {1LL, 2LL, static_cast<long long>(box.uniform(1.0, double(count))), count}) {
    if (k < 1 || k > count) continue;
    expect_impact_enclosed(motion, k);
    // The doubles around the instant, of which one has two sides.
    const auto hit = motion.impact(k);
    for (const double t : {hit.when.lo, hit.when.hi})
      for (const auto side : {Side::left, Side::right})
        if (t <= end) expect_enclosed(motion, t, side);
  }
}

TEST(Enclosure, HoldsTheDoubleResultsOfPairsAllOverTheBox) {
  constexpr unsigned seed = 20260502;
  Box box(seed);
  for (int i = 0; i < trials(150); ++i) {
    const auto p = box.pair();
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i << " X = " << p.X
                                    << " xi1 = " << p.xi1 << " eta = " << p.eta);
    expect_all_enclosed(SynchronizedPair(p), box);
  }
}

TEST(Enclosure, HoldsTheDoubleResultsOfExactDataAndSingleMasses) {
  constexpr unsigned seed = 20260503;
  Box box(seed);
  for (const double eta : {1.0, 0.75, 0.0}) {
    expect_all_enclosed(ExactDataPair({.sigma = 0x1p-7, .X = 399999.0, .r = 1.25, .eta = eta}),
                        box);
    expect_all_enclosed(ExactDataPair({.sigma = 0.0, .r = 4.25, .eta = eta, .t_end = 1e9}), box);
    for (const double xi1 : {0.0, 0.05, 0.999}) {
      expect_all_enclosed(RigidStop({xi1, eta, 1e4}), box);
      expect_all_enclosed(FreeMass({xi1, 1e4}), box);
    }
  }
}

TEST(Enclosure, ValuesThatAreZeroAreExactlyZero) {
  PairEnclosure undamped(Inputs(exact::PairParameters{.xi1 = 0.0}));
  const auto start = undamped.at(0.0, Side::right, bits);
  EXPECT_TRUE(start.v[0].is_zero() && start.v[1].is_zero());
  EXPECT_TRUE(undamped.impact(1, bits).before.a[1].is_zero());
  PairEnclosure plastic(Inputs(exact::PairParameters{.eta = 0.0}));
  const auto rest = plastic.at(10.0, Side::right, bits);
  for (const auto* part : {&rest.u, &rest.v, &rest.a})
    for (const auto& value : *part) EXPECT_TRUE(value.is_zero());
  EXPECT_TRUE(plastic.impact(1, bits).energy_after.is_zero());
  // Omega = sigma: sigma^2 - Omega^2 is 0 to every bit.
  PairEnclosure balanced(Inputs(exact::ExactDataParameters{.Omega = 0.75, .sigma = 0.75}));
  EXPECT_TRUE(balanced.at(0.0, Side::right, bits).a[0].is_zero());
}

TEST(Enclosure, BallsOfMorePrecisionLieWithinThoseOfLess) {
  PairEnclosure enclosure(Inputs(exact::PairParameters{.X = 21.0, .eta = 0.7}));
  for (const double t : {0.3, 7.0, 1e4}) {
    const auto rough = enclosure.at(t, Side::right, 20), fine = enclosure.at(t, Side::right, 4000);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_TRUE(arb_overlaps(rough.u[i].get(), fine.u[i].get()));
      EXPECT_GE(fine.u[i].accuracy(), 4000);
      EXPECT_LT(rough.u[i].accuracy(), 4000);
    }
  }
  const auto rough = enclosure.instant(5, 30), fine = enclosure.instant(5, 3000);
  EXPECT_TRUE(arb_overlaps(rough.get(), fine.get()));
  EXPECT_GE(fine.accuracy(), 3000);
}

TEST(Enclosure, InstantsAreOddMultiplesOfTheFirst) {
  PairEnclosure enclosure(Inputs(exact::PairParameters{.k1 = 2.0, .xi1 = 0.3}));
  const WorkingBits scope(300);
  for (const long long k : {2LL, 3LL, 1000001LL}) {
    const Ball rest =
        enclosure.instant(k, 250) - Ball(double(2 * k - 1)) * enclosure.instant(1, 250);
    EXPECT_TRUE(rest.holds_zero());
    EXPECT_LT(std::abs(rest.middle()), 1e-60);
  }
}

TEST(Enclosure, VelocityAndAccelerationAreTheDerivatives) {
  // Nothing of the formula: at doubles t -+ h the central difference is the derivative up to
  // h^2/6 times the third one, at most |b| omega^3 (that of v omega^4).
  constexpr unsigned seed = 20260504;
  Box box(seed);
  for (int i = 0; i < trials(30); ++i) {
    // Nothing underflows: the envelope is a double.
    const double odd = 2.0 * std::floor(box.uniform(0.0, 200.0)) + 1.0;
    const bool exchanged = odd > 1.0 && box.one_in(3);
    const double r = box.uniform(0.1, 2.9);
    const exact::PairParameters p{.m1 = box.decades(-2.0, 2.0),
                                  .k1 = box.decades(-2.0, 2.0),
                                  .xi1 = box.uniform(0.0, exchanged ? 0.9 / odd : 0.9),
                                  .A = box.decades(-2.0, 2.0),
                                  .X = exchanged ? 1.0 / odd : odd,
                                  .r = exchanged ? 1.0 / r : r,
                                  .eta = box.uniform(0.5, 1.0),
                                  .t_end = 1e8};
    const SynchronizedPair motion(p);
    PairEnclosure enclosure{Inputs(p)};
    // The middle of a flight, so that both neighbours belong to it.
    const double t = motion.constants().period * std::floor(box.uniform(0.0, 20.0)) +
                     0.0625 * motion.constants().period;
    // t + h and t - h round by up to 2^-53 t, which is 2^-13 h.
    const double h = std::ldexp(t, -40), low = t - h, high = t + h;
    const WorkingBits scope(400);
    const auto before = enclosure.at(low, Side::right, 300),
               now = enclosure.at(t, Side::right, 300),
               after = enclosure.at(high, Side::right, 300);
    const Ball width = Ball(high) - low;
    const auto envelope = motion.envelope(t);
    for (std::size_t m = 0; m < 2; ++m) {
      const auto e = static_cast<Eigen::Index>(m);
      const double omega = m == 0 ? motion.constants().omega1 : motion.constants().omega2;
      // A quarter of the second derivative for times off the middle, a sixth of the third.
      const double slack = std::ldexp(h * omega, -13) + h * omega * h * omega;
      EXPECT_TRUE(abs((after.u[m] - before.u[m]) / width - now.v[m]) < Ball(envelope.v[e] * slack));
      EXPECT_TRUE(abs((after.v[m] - before.v[m]) / width - now.a[m]) < Ball(envelope.a[e] * slack));
    }
  }
}

}  // namespace
}  // namespace clackers::certified

#endif
