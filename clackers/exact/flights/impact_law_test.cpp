#include "clackers/exact/flights/piecewise_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "clackers/base/constants.hpp"
#include "clackers/base/testing/refusal.hpp"
#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/exact/testing/impact_simulator.hpp"

namespace clackers::exact {
namespace {

using model::Side;

constexpr int most_impacts = 10000;

PiecewiseMotion simulated(const model::ImpactProblem<>& problem, const ImpactLaw& law,
                          double until) {
  return PiecewiseMotion(problem, law, until, most_impacts);
}

std::vector<double> grid(double end, int parts) {
  std::vector<double> t;
  for (int i = 0; i <= parts; ++i) t.push_back(std::min(end, end * i / parts));
  return t;
}

// The largest distance over the envelope at t = 0.
double distance(const PiecewiseMotion& motion, const ClosedForm& form, std::span<const double> t) {
  std::vector<double> u(t.size() * std::size_t(motion.dof())), v(u.size());
  motion.sample(t, Side::right, {u, v, {}});
  double largest = 0.0;
  const auto scale = form.envelope(0.0);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto known = form.at(t[i], Side::right);
    for (Eigen::Index j = 0; j < known.u.size(); ++j)
      largest = std::max(
          largest,
          std::abs(u[i * std::size_t(motion.dof()) + std::size_t(j)] - known.u[j]) / scale.u[j]);
  }
  return largest;
}

TEST(ImpactLaw, IsTheClosedFormOfTheClass) {
  const auto t = grid(20.0, 700);
  const auto agrees = [&](const ClosedForm& form, double bound) {
    const auto motion = simulated(form.problem(), {}, 20.0);
    EXPECT_EQ(motion.impact_count(20.0), form.impact_count(20.0));
    EXPECT_LT(distance(motion, form, t), bound);
  };
  // The doubles of the problem move phases of up to 20 X radians by a few 2^-53 of themselves, and
  // impacts with r > 1 magnify that.
  agrees(SynchronizedPair({.X = 9.0}), 1e-12);
  agrees(SynchronizedPair({.xi1 = 0.0, .X = 5.0, .r = 0.5}), 1e-12);
  agrees(SynchronizedPair({.X = 1.0, .r = 1.0, .eta = 0.8}), 1e-12);
  agrees(SynchronizedPair({.X = 401.0}), 1e-11);
  agrees(RigidStop({0.05, 0.7, 20.0}), 1e-12);
  agrees(RigidStop({0.0, 1.0, 20.0}), 1e-12);
  agrees(FreeMass({0.05, 20.0}), 1e-12);
}

TEST(ImpactLaw, FollowsASimulationWithNinetyDigitsForOtherSystems) {
  auto problem = SynchronizedPair({.X = 9.0}).problem();
  problem.system.mass(1, 1) *= 1.03;
  problem.system.stiffness(0, 0) *= 0.98;
  problem.system.damping(1, 1) *= 2.5;  // not proportional to the mass
  problem.contacts[0].restitution = 0.9;
  problem.contacts[0].gap = -0.02;
  using testing_oracle::Real;
  const auto& s = problem.system;
  const testing_oracle::RawPair raw{s.mass(0, 0),
                                    s.mass(1, 1),
                                    s.stiffness(0, 0),
                                    s.stiffness(1, 1),
                                    s.damping(0, 0),
                                    s.damping(1, 1),
                                    0.9,
                                    0.02,
                                    problem.start.u[0],
                                    problem.start.u[1],
                                    problem.start.v[0],
                                    problem.start.v[1]};
  // The simulator's contact is at u1 - u2 = -gap.
  const auto motion = simulated(problem, {}, 12.0);
  ASSERT_GE(motion.impact_count(12.0), 4);
  std::vector<Real> times;
  const auto t = grid(12.0, 97);
  for (const double x : t) times.push_back(x);
  const auto states = testing_oracle::simulate(raw, times);
  std::vector<double> u(2 * t.size()), v(2 * t.size());
  motion.sample(t, Side::right, {u, v, {}});
  for (std::size_t i = 0; i < t.size(); ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_NEAR(u[2 * i + j], double(states[i].u[j]), 1e-13) << t[i];
      EXPECT_NEAR(v[2 * i + j], double(states[i].v[j]), 1e-12) << t[i];
    }
}

TEST(ImpactLaw, ImpactsObeyTheirLawAndDepartures) {
  const auto problem = SynchronizedPair({.X = 5.0, .eta = 0.9}).problem();
  const auto jump = [&](const ImpactLaw& law, int number) {
    const auto motion = simulated(problem, law, 20.0);
    const double t = motion.impact(number + 1).t;
    const auto before = motion.at(t - 1e-9, Side::right).v, after = motion.at(t, Side::right).v;
    return std::array{after[0] - before[0], after[1] - before[1], before[0] - before[1],
                      after[0] - after[1]};
  };
  const double m1 = problem.system.mass(0, 0), m2 = problem.system.mass(1, 1);
  const auto right = jump({}, 2);
  EXPECT_NEAR(right[3], -0.9 * right[2], 1e-7);  // 1 ns of accelerations below 10
  EXPECT_NEAR(m1 * right[0] + m2 * right[1], 0.0, 1e-7);
  EXPECT_GT(right[0], 0.01);
  const auto doubled = jump({.doubled = 3}, 2);
  EXPECT_NEAR(doubled[0], 2.0 * right[0], 1e-7);
  const auto missed = jump({.missed = 3}, 2);
  EXPECT_NEAR(missed[0], 0.0, 1e-7);
  const auto wrong = jump({.impulse_factor = {1.0, 1.1}}, 0), first = jump({}, 0);
  EXPECT_NEAR(wrong[1], 1.1 * first[1], 1e-7);
  EXPECT_NEAR(wrong[0], first[0], 1e-7);
}

TEST(ImpactLaw, ImpactsOfAGridActAtItsTimes) {
  const auto problem = SynchronizedPair({.X = 5.0}).problem();
  const double h = 0.013;
  const auto motion = simulated(problem, {.grid = h}, 20.0), exact = simulated(problem, {}, 20.0);
  EXPECT_EQ(motion.impact_count(20.0), exact.impact_count(20.0));
  for (int k = 1; k <= motion.impact_count(20.0); ++k)
    EXPECT_NEAR(motion.impact(k).t / h, std::round(motion.impact(k).t / h), 1e-9);
  const double delay = motion.impact(1).t - exact.impact(1).t;
  EXPECT_GE(delay, 0.0);
  EXPECT_LT(delay, h);
}

TEST(ImpactLaw, DampingAfterTheFirstImpactChangesTheDecay) {
  const auto problem = RigidStop({0.05, 1.0, 20.0}).problem();
  const auto motion = simulated(problem, {.damping_after_impact = 0.0}, 20.0);
  ASSERT_GE(motion.impact_count(20.0), 4);
  const auto second = motion.impact(2), third = motion.impact(3);
  // Without damping the speed at the stop stays.
  EXPECT_NEAR(third.impulse, second.impulse, 1e-12 * second.impulse);
  EXPECT_NEAR(third.t - second.t, std::numbers::pi, 1e-12);
}

TEST(ImpactLaw, MotionsWithoutBoundsAreRefusedWhereTheyAreNotAvailable) {
  auto problem = SynchronizedPair({.X = 5.0, .eta = 0.9}).problem();
  EXPECT_REFUSED(PiecewiseMotion(problem, {}, 20.0, 3), "out-of-memory", "impacts");
  problem.contacts[0].gap = 5.0;
  EXPECT_REFUSED(simulated(problem, {}, 20.0), "out-of-range", "violated");
  problem.contacts.clear();
  EXPECT_EQ(simulated(problem, {}, 20.0).error_bound(1.0).u[0], infinity);
  problem.system.add_load = [](double, std::span<double>) {};
  EXPECT_REFUSED(simulated(problem, {}, 20.0), "linear-only", "load");
}

// Bounds need damping and restitutions that lose energy; a fit tries others.
TEST(ImpactLaw, EnergyMayGrow) {
  auto problem = RigidStop({0.0, 1.0, 20.0}).problem();
  problem.contacts[0].restitution = 1.1;
  const auto motion = simulated(problem, {}, 20.0);
  EXPECT_NEAR(motion.impact(3).impulse, 1.21 * motion.impact(1).impulse, 1e-12);
  problem.contacts[0].restitution = 1.0;
  problem.system.damping(0, 0) = -0.02;
  const auto growing = simulated(problem, {}, 20.0);
  const double half = growing.impact(2).t - growing.impact(1).t;
  EXPECT_NEAR(growing.impact(2).impulse, std::exp(0.01 * half) * growing.impact(1).impulse, 1e-12);
}

TEST(ImpactLaw, PlasticImpactAtEquilibriumEndsTheMotion) {
  const RigidStop stop({0.05, 0.0, 20.0});
  const auto motion = simulated(stop.problem(), {}, 20.0);
  EXPECT_EQ(motion.impact_count(20.0), 1);
  EXPECT_NEAR(motion.at(15.0, Side::right).u[0], 0.0, 1e-15);
  EXPECT_REFUSED(motion.at(21.0, Side::right), "time-outside", "21");
}

}  // namespace
}  // namespace clackers::exact
