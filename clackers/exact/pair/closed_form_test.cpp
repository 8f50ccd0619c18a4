#include "clackers/exact/pair/closed_form.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <thread>

#include "clackers/base/error.hpp"
#include "clackers/exact/testing/test_oracle.hpp"

namespace clackers::exact {
namespace {

using model::Kinematics;
using model::Side;
using namespace testing_oracle;

constexpr double spacing = std::numeric_limits<double>::denorm_min();

// The largest error of a state in units of 2^-52 of the component's envelope, after two subnormal
// spacings are forgiven; and whether the stated bound and envelope hold.
struct Check {
  double worst = 0.0;
  bool bound_holds = true, envelope_holds = true;
};

void compare(const Real& reference, double value, const Real& envelope, double stated, double bound,
             Check& check) {
  const Real error = abs(reference - Real(value));
  if (envelope > 0 && error > 2 * Real(spacing)) {
    const double units = double(ldexp((error - 2 * Real(spacing)) / envelope, 52));
    check.worst = std::max(check.worst, units);
  }
  if (error > Real(bound)) check.bound_holds = false;
  // Two roundings in the envelope, and it may be subnormal.
  if (abs(Real(stated) - envelope) > ldexp(envelope, -51) + 2 * Real(spacing))
    check.envelope_holds = false;
}

Check check_at(const ClosedForm& motion, const Oracle& oracle, double t, Side side) {
  Check check;
  const auto state = motion.at(t, side);
  const auto bound = motion.error_bound(t);
  const auto envelope = motion.envelope(t);
  const auto reference = oracle.state(t, side);
  const auto widest = oracle.state(t, Side::left);
  for (int i = 0; i < oracle.dof; ++i) {
    compare(reference.u[i], state.u[i], widest.u_env[i], envelope.u[i], bound.u[i], check);
    compare(reference.v[i], state.v[i], widest.v_env[i], envelope.v[i], bound.v[i], check);
    compare(reference.a[i], state.a[i], widest.a_env[i], envelope.a[i], bound.a[i], check);
  }
  return check;
}

void expect_true(const ClosedForm& motion, const Oracle& oracle, double t) {
  for (const auto side : {Side::left, Side::right}) {
    const auto check = check_at(motion, oracle, t, side);
    // 0.51 is what error_bound() derives; the promise to users is 2.
    EXPECT_LE(check.worst, 0.51) << "t = " << t << (side == Side::left ? " left" : " right");
    EXPECT_TRUE(check.bound_holds) << "t = " << t;
    EXPECT_TRUE(check.envelope_holds) << "t = " << t;
    EXPECT_EQ(motion.impact_count(t),
              oracle.eta == 0.0 ? std::min(1LL, oracle.impacts(t)) : oracle.impacts(t))
        << "t = " << t;
  }
}

// Times of every size up to the end, and some within 4 ulp of impacts.
std::vector<double> times(Box& box, const Oracle& oracle, double end) {
  std::vector<double> result{0.0, end, spacing, box.uniform(0.0, end),
                             end * box.decades(-12.0, 0.0)};
  if (!oracle.collides) return result;
  const double all = double(oracle.omega) * end / 3.2;
  for (const double k :
       {1.0, std::floor(box.uniform(1.0, std::max(2.0, all))), std::floor(box.decades(0.0, 4.0))}) {
    double t = double(oracle.instant(k));
    for (int ulp = 0; ulp < 4; ++ulp) t = std::nextafter(t, 0.0);
    for (int ulp = -4; ulp <= 4; ++ulp, t = std::nextafter(t, INFINITY))
      if (ulp % 2 == 0 || std::abs(ulp) == 1)
        if (t <= end) result.push_back(t);
  }
  return result;
}

std::string words(const PairParameters& p) {
  std::ostringstream out;
  out.precision(17);
  out << "m1=" << p.m1 << " k1=" << p.k1 << " xi1=" << p.xi1 << " A=" << p.A << " X=" << p.X
      << " r=" << p.r << " eta=" << p.eta << " t_end=" << p.t_end;
  return out.str();
}

TEST(ClosedForm, IsTrueToHalfAnUlpOfTheEnvelopeOverTheWholeBox) {
  constexpr unsigned seed = 20260101;
  Box box(seed);
  for (int i = 0; i < trials(60); ++i) {
    const auto p = box.pair();
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i << ": " << words(p));
    const SynchronizedPair motion(p);
    const auto oracle = oracle_of(p);
    for (const double t : times(box, oracle, p.t_end)) expect_true(motion, oracle, t);
    if (HasFailure()) return;
  }
}

TEST(ClosedForm, IsTrueAtTheEdgesOfTheRangesOfScale) {
  constexpr unsigned seed = 20260102;
  Box box(seed);
  for (const double m1 : {1e-60, 1e60})
    for (const double k1 : {1e-60, 1e60})
      for (const double A : {1e-60, 1e60})
        for (const double r : {1e-60, 2.5}) {
          PairParameters p{
              .m1 = m1, .k1 = k1, .xi1 = 0.3, .A = A, .X = 400001.0, .r = r, .eta = 0.9};
          p.t_end = 1e6 * std::sqrt(m1 / k1);
          SCOPED_TRACE(words(p));
          const auto oracle = oracle_of(p);
          const SynchronizedPair motion(p);
          for (const double t : times(box, oracle, p.t_end)) expect_true(motion, oracle, t);
          p.X = 1.0 / 400001.0;
          p.r = 1.0 / r;
          const SynchronizedPair exchanged(p);
          for (const double t : times(box, oracle_of(p), p.t_end))
            expect_true(exchanged, oracle_of(p), t);
        }
}

TEST(ClosedForm, IsTrueAtLongTimesOfFastPairs) {
  constexpr unsigned seed = 20260103;
  Box box(seed);
  for (const double X : {1.0, 3.0, 9.0, 399999.0, 400001.0, 999999999.0})
    for (const double xi1 : {0.0, 1e-9, 1e-7}) {
      const PairParameters p{.xi1 = xi1, .X = X, .r = 2.5, .eta = 1.0, .t_end = 1e9};
      SCOPED_TRACE(words(p));
      const SynchronizedPair motion(p);
      const auto oracle = oracle_of(p);
      for (int i = 0; i < trials(3); ++i) expect_true(motion, oracle, box.uniform(0.9e9, 1e9));
      for (const double k : {3e8, 318309886.0, 123456789.0}) {
        const double t = double(oracle.instant(k));
        for (const double near : {std::nextafter(t, 0.0), t, std::nextafter(t, 2e9)})
          if (near <= p.t_end) expect_true(motion, oracle, near);
      }
    }
}

TEST(ClosedForm, SurvivesWhereTheNumberOfImpactsIsLargest) {
  // 2^50 impacts: the spacing of doubles at the end is a fifth of a period, so every other
  // time or so is the nearest double of an impact.
  PairParameters p{.xi1 = 0.0, .X = 9.0, .r = 0.5, .t_end = 0x1p50 * 3.14159265};
  const SynchronizedPair motion(p);
  const auto oracle = oracle_of(p);
  double t = p.t_end;
  for (int i = 0; i < 20; ++i, t = std::nextafter(t, 0.0)) expect_true(motion, oracle, t);
}

TEST(ClosedForm, IsTrueDownIntoTheSubnormalNumbersAndBeyond) {
  constexpr unsigned seed = 20260104;
  Box box(seed);
  // 0.05 t = 690 to 790 covers the whole way from normal numbers to zero.
  const PairParameters damped{.t_end = 20000.0};
  const SynchronizedPair motion(damped);
  for (int i = 0; i < trials(100); ++i)
    expect_true(motion, oracle_of(damped), box.uniform(13600.0, 16000.0));
  const auto at_end = motion.at(20000.0, Side::right);
  EXPECT_EQ(at_end.u.norm() + at_end.v.norm() + at_end.a.norm(), 0.0);

  // The same by restitution alone, 0.5^k, and by both at once with an enormous amplitude.
  const PairParameters plastic{.xi1 = 0.0, .A = 1e60, .eta = 0.5, .t_end = 8000.0};
  for (int i = 0; i < trials(100); ++i)
    expect_true(SynchronizedPair(plastic), oracle_of(plastic), box.uniform(3000.0, 5000.0));
  const PairParameters tiny{.A = 1e-60, .eta = 5e-324, .t_end = 20.0};
  for (const double t : {1.0, 2.0, 5.0, 9.0})
    expect_true(SynchronizedPair(tiny), oracle_of(tiny), t);
}

TEST(ClosedForm, FreeMassAndRigidStopFollowTheirFormulas) {
  constexpr unsigned seed = 20260105;
  Box box(seed);
  for (int i = 0; i < trials(20); ++i) {
    const FreeMassParameters free{box.damping_ratio(), box.decades(0.0, 8.0)};
    const RigidStopParameters stop{box.damping_ratio(), box.restitution(), box.decades(1.0, 8.0)};
    SCOPED_TRACE(testing::Message() << "seed " << seed << " xi1 " << free.xi1 << " and " << stop.xi1
                                    << " eta " << stop.eta);
    for (const double t : times(box, oracle_of(free), free.t_end))
      expect_true(FreeMass(free), oracle_of(free), t);
    for (const double t : times(box, oracle_of(stop), stop.t_end))
      expect_true(RigidStop(stop), oracle_of(stop), t);
  }
  // Both halves of a turn of the free mass.
  for (const double t : {1.0, 2.0, 4.0, 5.0})
    expect_true(FreeMass({}), oracle_of(FreeMassParameters{}), t);
}

TEST(ClosedForm, SideDecidesOnlyAtTheDoubleNearestToAnImpact) {
  const SynchronizedPair motion({});
  for (const long long k : {1LL, 2LL, 6LL}) {
    const double t = motion.impact(k).t;
    EXPECT_LT(motion.at(t, Side::left).v[0], 0.0);
    EXPECT_GT(motion.at(t, Side::right).v[0], 0.0);
    const double below = std::nextafter(t, 0.0), above = std::nextafter(t, 1e9);
    for (const auto side : {Side::left, Side::right}) {
      EXPECT_LT(motion.at(below, side).v[0], 0.0);
      EXPECT_GT(motion.at(above, side).v[0], 0.0);
    }
  }
}

TEST(ClosedForm, ImpactsAreTrueAndTheirTimesEnclosed) {
  constexpr unsigned seed = 20260106;
  Box box(seed);
  for (int i = 0; i < trials(60); ++i) {
    const auto p = box.pair();
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i << ": " << words(p));
    const SynchronizedPair motion(p);
    const auto o = oracle_of(p);
    const auto last = motion.impact_count(p.t_end);
    for (const long long k :
         {1LL, 2LL, static_cast<long long>(box.decades(0.0, 3.0)),
          static_cast<long long>(box.uniform(1.0, std::max(2.0, double(last))))}) {
      if (k < 1 || k > last) continue;
      const auto hit = motion.impact(k);
      const Real t = o.instant(double(k));
      EXPECT_EQ(hit.index, k);
      EXPECT_EQ(hit.contact, 0);
      EXPECT_EQ(hit.t, double(t));
      EXPECT_TRUE(Real(hit.when.lo) < t && t < Real(hit.when.hi));
      EXPECT_EQ(std::nextafter(hit.when.lo, INFINITY), hit.when.hi);
      EXPECT_TRUE(hit.t == hit.when.lo || hit.t == hit.when.hi);

      // Relative to each value itself; a zero restitution ends all.
      const auto near = [&](const Real& reference, double value) {
        EXPECT_LE(abs(reference - Real(value)),
                  ldexp(abs(reference) * Real(0.51), -52) + Real(spacing))
            << "k " << k;
      };
      const Real before = o.decay(k - 1, t), after = p.eta == 0.0 ? Real(0) : o.decay(k, t);
      Real energy_before = 0, energy_after = 0;
      for (int m = 0; m < 2; ++m) {
        const auto& mass = o.mass[m];
        // At odd multiples of pi/2 of the slow mass; each flight starts anew, so t_1 shows the
        // sign.
        const Real hit_v = -mass.start * mass.frequency * sin(mass.frequency * o.instant(1.0));
        EXPECT_EQ(hit.before.u[m], 0.0);
        EXPECT_EQ(hit.after.u[m], 0.0);
        near(hit_v * before, hit.before.v[m]);
        near(-hit_v * after, hit.after.v[m]);
        near(-2 * o.sigma * hit_v * before, hit.before.a[m]);
        near(2 * o.sigma * hit_v * after, hit.after.a[m]);
        energy_before += mass.mass * hit_v * hit_v * before * before / 2;
        energy_after += mass.mass * hit_v * hit_v * after * after / 2;
        if (m == 0) near(-(1 + Real(p.eta)) * mass.mass * hit_v * before, hit.impulse);
      }
      near(energy_before, hit.energy_before);
      near(energy_after, hit.energy_after);
      EXPECT_GE(hit.impulse, 0.0);
    }
  }
}

TEST(ClosedForm, EarlyImpactsAreCountedOnTheRightSideOfTheirInstants) {
  // There the phase of a neighbouring double is a half to the last bit, and its low part decides.
  constexpr unsigned seed = 20260107;
  Box box(seed);
  for (int i = 0; i < trials(100); ++i) {
    const RigidStop motion({.xi1 = box.uniform(0.0, 0.9), .t_end = 100.0});
    for (long long k = 1; k <= 5; ++k) {
      const auto when = motion.impact(k).when;
      EXPECT_EQ(motion.impact_count(when.lo), k - 1) << "trial " << i << " seed " << seed;
      EXPECT_EQ(motion.impact_count(when.hi), k) << "trial " << i << " seed " << seed;
    }
  }
}

TEST(ClosedForm, ImpactsAreCountedByTheTrueInstantUpToTheLast) {
  const SynchronizedPair motion({});
  EXPECT_EQ(motion.impact_count(0.0), 0);
  EXPECT_EQ(motion.impact_count(motion.impact(1).when.lo), 0);
  EXPECT_EQ(motion.impact_count(motion.impact(1).when.hi), 1);
  EXPECT_EQ(motion.impact_count(20.0), 6);
  EXPECT_EQ(FreeMass({}).impact_count(20.0), 0);
  EXPECT_EQ(RigidStop({}).impact_count(20.0), 6);
}

TEST(ClosedForm, WithoutRestitutionTheMassesRestAfterTheFirstImpact) {
  const SynchronizedPair motion({.eta = 0.0});
  EXPECT_EQ(motion.impact_count(20.0), 1);
  const auto hit = motion.impact(1);
  EXPECT_GT(hit.before.v[1], 0.0);
  EXPECT_EQ(hit.after.v.norm() + hit.after.a.norm(), 0.0);
  EXPECT_EQ(hit.energy_after, 0.0);
  EXPECT_GT(hit.impulse, 0.0);
  for (const double t : {2.0, 5.0, 20.0}) {
    const auto rest = motion.at(t, Side::right);
    EXPECT_EQ(rest.u.norm() + rest.v.norm() + rest.a.norm(), 0.0);
    EXPECT_EQ(motion.envelope(t).u.norm(), 0.0);
  }
  EXPECT_THROW(motion.impact(2), InputError);
}

TEST(ClosedForm, ManyTimesAreTheSameAsOneByOneWithAndWithoutAccelerations) {
  const SynchronizedPair motion({.eta = 0.9});
  const std::vector<double> t{7.0, 0.0, 20.0, 3.5};
  std::vector<double> u(8), v(8), a(8), u_again(8), v_again(8);
  motion.sample(t, Side::right, {u, v, a});
  motion.sample(t, Side::right, {u_again, v_again, {}});
  EXPECT_EQ(u, u_again);
  EXPECT_EQ(v, v_again);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto one = motion.at(t[i], Side::right);
    for (std::size_t m = 0; m < 2; ++m) {
      EXPECT_EQ(one.u[long(m)], u[2 * i + m]);
      EXPECT_EQ(one.v[long(m)], v[2 * i + m]);
      EXPECT_EQ(one.a[long(m)], a[2 * i + m]);
    }
  }
}

void expect_refused(auto call, std::string_view code, std::string_view part) {
  try {
    call();
    FAIL() << "not refused; expected [" << code << "]";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code().name(), code) << error.what();
    EXPECT_NE(std::string_view(error.what()).find(part), std::string_view::npos) << error.what();
  }
}

TEST(ClosedForm, RefusesTimesOutsideImpactsBeyondAndBuffersThatDoNotFit) {
  const SynchronizedPair motion({});
  for (const double t : {-1.0, -5e-324, std::nextafter(20.0, 30.0)}) {
    expect_refused([&] { motion.at(t, Side::left); }, "time-outside", "0 <= t <= 20");
    expect_refused([&] { motion.envelope(t); }, "time-outside", "t = ");
    expect_refused([&] { motion.error_bound(t); }, "time-outside", "t = ");
    expect_refused([&] { motion.impact_count(t); }, "time-outside", "t = ");
  }
  expect_refused([&] { motion.at(NAN, Side::left); }, "not-a-number", "t = nan");
  expect_refused([&] { motion.at(INFINITY, Side::left); }, "not-finite", "t = inf");
  for (const long long k : {-1LL, 0LL, 7LL})
    expect_refused([&] { motion.impact(k); }, "beyond-last-impact", "1 to 6");
  expect_refused([&] { FreeMass({}).impact(1); }, "beyond-last-impact", "none");

  const std::vector<double> t{1.0, 2.0};
  std::vector<double> four(4), three(3);
  expect_refused([&] { motion.sample(t, Side::left, {three, four, {}}); }, "wrong-size", "4 each");
  expect_refused([&] { motion.sample(t, Side::left, {four, three, {}}); }, "wrong-size", "3");
  expect_refused([&] { motion.sample(t, Side::left, {four, four, three}); }, "wrong-size", "3");
}

TEST(ClosedForm, NeverGivesANegativeZero) {
  const auto expect_positive_zeros = [](const model::Kinematics& now) {
    for (const auto* part : {&now.u, &now.v, &now.a})
      for (const double x : *part) EXPECT_FALSE(x == 0.0 && std::signbit(x));
  };
  for (const double xi1 : {0.0, 0.05})
    for (const double eta : {0.0, 1.0})
      for (const double X : {5.0, 7.0}) {
        const SynchronizedPair motion({.xi1 = xi1, .X = X, .eta = eta});
        for (const double t : {0.0, 1.0, motion.impact(1).t, 7.0, 20.0})
          for (const auto side : {Side::left, Side::right})
            expect_positive_zeros(motion.at(t, side));
        const auto hit = motion.impact(1);
        expect_positive_zeros(hit.before);
        expect_positive_zeros(hit.after);
        EXPECT_FALSE(std::signbit(hit.energy_after));
      }
}

TEST(ClosedForm, MayBeAskedFromSeveralThreadsAtOnce) {
  const SynchronizedPair motion({.X = 401.0, .t_end = 1e6});
  std::vector<double> t(2000);
  for (std::size_t i = 0; i < t.size(); ++i) t[i] = 333.3 * double(i);
  std::vector<std::vector<double>> u(3, std::vector<double>(4000)), v = u;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 3; ++i)
    threads.emplace_back([&, i] { motion.sample(t, Side::right, {u[i], v[i], {}}); });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(u[0], u[1]);
  EXPECT_EQ(v[1], v[2]);
}

}  // namespace
}  // namespace clackers::exact
