#include "clackers/exact/flights/event_driven_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/exact/testing/impact_simulator.hpp"

namespace clackers::exact {
namespace {

using model::Side;

std::vector<double> grid(double end, int parts) {
  std::vector<double> t;
  for (int i = 0; i <= parts; ++i) t.push_back(std::min(end, end * i / parts));
  return t;
}

// The largest distance over the envelope at t = 0.
double distance(const EventDrivenMotion& motion, const ClosedForm& form,
                std::span<const double> t) {
  std::vector<double> u(t.size() * std::size_t(motion.dof())), v(u.size());
  motion.sample(t, u, v);
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

TEST(EventDrivenMotion, IsTheClosedFormOfTheClass) {
  const auto t = grid(20.0, 700);
  const auto agrees = [&](const ClosedForm& form, double bound) {
    const auto motion = EventDrivenMotion::make(form.problem(), {}, 20.0);
    ASSERT_TRUE(motion);
    EXPECT_EQ(std::ssize(motion->impacts()), form.impact_count(20.0));
    EXPECT_LT(distance(*motion, form, t), bound);
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

TEST(EventDrivenMotion, FollowsASimulationWithNinetyDigitsForOtherSystems) {
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
  const auto motion = EventDrivenMotion::make(problem, {}, 12.0);
  ASSERT_TRUE(motion);
  ASSERT_GE(motion->impacts().size(), 4u);
  std::vector<Real> times;
  const auto t = grid(12.0, 97);
  for (const double x : t) times.push_back(x);
  const auto states = testing_oracle::simulate(raw, times);
  std::vector<double> u(2 * t.size()), v(2 * t.size());
  motion->sample(t, u, v);
  for (std::size_t i = 0; i < t.size(); ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_NEAR(u[2 * i + j], double(states[i].u[j]), 1e-13) << t[i];
      EXPECT_NEAR(v[2 * i + j], double(states[i].v[j]), 1e-12) << t[i];
    }
}

TEST(EventDrivenMotion, ImpactsObeyTheirLawAndDepartures) {
  const auto problem = SynchronizedPair({.X = 5.0, .eta = 0.9}).problem();
  const auto at = [](const EventDrivenMotion& motion, double t) {
    std::vector<double> u(2), v(2);
    motion.sample({&t, 1}, u, v);
    return std::array{u[0], u[1], v[0], v[1]};
  };
  const auto jump = [&](const ImpactLaw& law, int number) {
    const auto motion = EventDrivenMotion::make(problem, law, 20.0);
    const double t = motion->impacts().at(std::size_t(number)).t;
    const auto before = at(*motion, t - 1e-9), after = at(*motion, t);
    return std::array{after[2] - before[2], after[3] - before[3], before[2] - before[3],
                      after[2] - after[3]};
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

TEST(EventDrivenMotion, ImpactsOfAGridActAtItsTimes) {
  const auto problem = SynchronizedPair({.X = 5.0}).problem();
  const double h = 0.013;
  const auto motion = EventDrivenMotion::make(problem, {.grid = h}, 20.0);
  const auto exact = EventDrivenMotion::make(problem, {}, 20.0);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->impacts().size(), exact->impacts().size());
  for (const auto& hit : motion->impacts()) EXPECT_NEAR(hit.t / h, std::round(hit.t / h), 1e-9);
  const double delay = motion->impacts()[0].t - exact->impacts()[0].t;
  EXPECT_GE(delay, 0.0);
  EXPECT_LT(delay, h);
}

TEST(EventDrivenMotion, DampingAfterTheFirstImpactChangesTheDecay) {
  const auto problem = RigidStop({0.05, 1.0, 20.0}).problem();
  const auto motion = EventDrivenMotion::make(problem, {.damping_after_impact = 0.0}, 20.0);
  ASSERT_TRUE(motion);
  const auto& hits = motion->impacts();
  ASSERT_GE(hits.size(), 4u);
  // Without damping the speed at the stop stays.
  EXPECT_NEAR(hits[2].impulse, hits[1].impulse, 1e-12 * hits[1].impulse);
  EXPECT_NEAR(hits[2].t - hits[1].t, std::numbers::pi, 1e-12);
}

TEST(EventDrivenMotion, IsNotAvailableWhereImpactsAccumulateOrRest) {
  // Pressed together at rest: impacts with restitution accumulate.
  auto problem = SynchronizedPair({.X = 5.0, .eta = 0.5}).problem();
  problem.contacts[0].gap = 0.3;
  EXPECT_FALSE(EventDrivenMotion::make(problem, {}, 200.0));
  // Overlapping at the start.
  problem.contacts[0].gap = 5.0;
  EXPECT_FALSE(EventDrivenMotion::make(problem, {}, 20.0));
  problem.contacts.clear();
  EXPECT_TRUE(EventDrivenMotion::make(problem, {}, 20.0));
  problem.system.add_load = [](double, std::span<double>) {};
  EXPECT_FALSE(EventDrivenMotion::make(problem, {}, 20.0));
}

TEST(EventDrivenMotion, PlasticImpactAtEquilibriumEndsTheMotion) {
  const RigidStop stop({0.05, 0.0, 20.0});
  const auto motion = EventDrivenMotion::make(stop.problem(), {}, 20.0);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->impacts().size(), 1u);
  const double t = 15.0;
  double u = 1.0;
  motion->sample({&t, 1}, {&u, 1}, {});
  EXPECT_NEAR(u, 0.0, 1e-15);
  const double late = 21.0;
  EXPECT_THROW(motion->sample({&late, 1}, {&u, 1}, {}), InputError);
}

}  // namespace
}  // namespace clackers::exact
