#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/measure/impacts/impact_finder.hpp"
#include "clackers/measure/testing/sampled_motion.hpp"

namespace clackers::measure {
namespace {

using std::numbers::pi;

TEST(ImpactFinder, InventsNothingInFreeMotion) {
  for (const double w2 : {1.0, 1.4, 5.0, 9.0, 40.0})
    for (const double phase : {0.0, 0.7, 2.0})
      for (const double a_period : {10.0, 11.7, 30.0, 300.0})
        for (const bool velocities : {true, false}) {
          const double step = 2.0 * pi / (w2 * a_period);
          const auto history =
              sampled(unconstrained_motion(1.0, w2, phase), 40.0, step, velocities);
          EXPECT_EQ(find_impacts(history, masses(1.0, w2)).size(), 0u)
              << "w2 " << w2 << " phase " << phase << " rows a period " << a_period
              << (velocities ? " with" : " without") << " velocities";
        }
}

TEST(ImpactFinder, InventsNothingInSixDigits) {
  for (const double a_period : {10.0, 300.0, 3000.0})
    for (const bool velocities : {true, false}) {
      const auto history = sampled(unconstrained_motion(1.0, 5.0, 0.7), 10.0,
                                   2.0 * pi / (5.0 * a_period), velocities);
      EXPECT_EQ(find_impacts(printed(history, 6), masses(1.0, 5.0)).size(), 0u)
          << a_period << (velocities ? " with" : " without") << " velocities";
    }
}

// Masses that swing in contact and do not press: the gap and its rate are the rounding of digits.
TEST(ImpactFinder, InventsNothingInAContactThatMoves) {
  auto problem = masses(1.0, 1.0);
  problem.contacts[0].direction = Eigen::Vector2d(1.0, -3.0);
  const StateAt together = [](double t) {
    const Eigen::Vector2d shape(1.0, 1.0 / 3.0);
    return FreeState{t, std::cos(t) * shape, -std::sin(t) * shape};
  };
  for (const double step : {0.3, 0.01})
    for (const bool velocities : {true, false})
      EXPECT_EQ(find_impacts(printed(sampled(together, 20.0, step, velocities), 6), problem).size(),
                0u)
          << step << (velocities ? " with" : " without") << " velocities";
}

// An impact that a method spreads over two steps: the rate of the gap goes -2, -0.6, 2.
TEST(ImpactFinder, TakesAnImpactOverTwoStepsForOne) {
  const auto free = Penalty{1e12};  // as good as rigid
  auto history = sampled(free, 3.0, 0.05, true);
  std::size_t behind = 0;
  while (history.t[behind] < 0.5 * pi) ++behind;
  history.v[2 * behind] = -0.3;
  history.v[2 * behind + 1] = 0.3;
  const auto found = find_impacts(history, equal_masses());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].impact.t, 0.5 * pi, 1e-6);
  EXPECT_EQ(found[0].end, history.t[behind + 1]);
  EXPECT_NEAR(found[0].impact.v_after[0], history.v[2 * behind + 2], 1e-12);
}

// Without restitution both stop for ever; a contact at rest is no impact.
TEST(ImpactFinder, FindsTheImpactThatEndsInRest) {
  const StateAt stops = [](double t) {
    const double x = t - 0.5 * pi;
    if (x > 0.0) return FreeState{t, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
    return FreeState{t, Eigen::Vector2d(-std::sin(x), std::sin(x)),
                     Eigen::Vector2d(-std::cos(x), std::cos(x))};
  };
  for (const bool velocities : {true, false}) {
    const auto found = find_impacts(sampled(stops, 10.0, 0.0503, velocities), equal_masses());
    ASSERT_EQ(found.size(), 1u) << velocities;
    EXPECT_NEAR(found[0].impact.t, 0.5 * pi, velocities ? 1e-8 : 1e-5);
    EXPECT_NEAR(found[0].impact.v_before[0], -1.0, velocities ? 1e-8 : 1e-3);
    EXPECT_NEAR(found[0].impact.v_after[0], 0.0, 1e-12);
    EXPECT_NEAR(found[0].impact.impulse, 1.0, velocities ? 1e-8 : 1e-3);
  }
}

// Mass 1 falls on a stop and stays there, a little too deep, pressed by its load.
TEST(ImpactFinder, TakesTheEndOfAFallForItsWholeImpact) {
  auto problem = equal_masses();
  problem.contacts[0] = {Eigen::Vector2d(1.0, 0.0), 0.0, 0.0};
  problem.system.stiffness.setZero();
  problem.system.add_load = [](double, std::span<double> force) { force[0] -= 1.0; };
  const double fall = std::sqrt(2.0);
  const StateAt motion = [=](double t) {
    const bool rests = t > fall;
    return FreeState{t, Eigen::Vector2d(rests ? -1e-12 : 1.0 - 0.5 * t * t, -1.0),
                     Eigen::Vector2d(rests ? 0.0 : -t, 0.0)};
  };
  const auto found = find_impacts(sampled(motion, 4.0, 0.03, true), problem);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].impact.t, fall, 1e-9);
  EXPECT_NEAR(found[0].end, fall, 0.03);
  ASSERT_EQ(found[0].impact.v_after.size(), 2u);
  EXPECT_NEAR(found[0].impact.v_after[0], 0.0, 0.03);
}

// Masses that pass through each other with one wrong velocity while they turn.
TEST(ImpactFinder, TakesAKickInsideForNoImpact) {
  auto history = sampled(unconstrained_motion(1.0, 1.0, 0.0), 6.0, 0.05, true);
  history.v[2 * 63] += 0.1;  // t = 3.15, just behind the deepest point
  EXPECT_EQ(find_impacts(history, equal_masses()).size(), 0u);
}

// Rest that rounding shakes.
TEST(ImpactFinder, TakesTheTremorOfRestForRest) {
  model::Trajectory history;
  history.dof = 2;
  for (int i = 0; i < 400; ++i) {
    const double t = 0.05 * i, x = t - 0.5 * pi, tremor = 1e-17 * std::sin(17.0 * i);
    history.t.push_back(t);
    const double u = x > 0.0 ? tremor : -std::sin(x), v = x > 0.0 ? tremor : -std::cos(x);
    history.u.insert(history.u.end(), {u, -u});
    history.v.insert(history.v.end(), {v, -v});
  }
  EXPECT_EQ(find_impacts(history, equal_masses()).size(), 1u);
}

// Mass 2 between mass 1 and a floor at -1.2: it hits the floor while mass 1 is far away.
TEST(ImpactFinder, TellsContactsApart) {
  auto problem = equal_masses();
  problem.contacts.push_back({Eigen::Vector2d(0.0, 1.0), -1.2, 1.0});
  const double hit = std::acos(-1.2 / 2.0) + 0.5 * pi - std::acos(0.0);  // 2 cos t = -1.2
  const StateAt motion = [&](double t) {
    const double x = t < hit ? t : 2.0 * hit - t, turn = t < hit ? 1.0 : -1.0;
    return FreeState{t, Eigen::Vector2d(3.0, 2.0 * std::cos(x)),
                     Eigen::Vector2d(0.0, -2.0 * turn * std::sin(x))};
  };
  problem.system.stiffness(0, 0) = 0.0;
  for (const bool velocities : {true, false}) {
    const auto found = find_impacts(sampled(motion, 2.0 * hit, 0.03, velocities), problem);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].impact.contact, 1);
    EXPECT_NEAR(found[0].impact.t, hit, 1e-6);
    EXPECT_NEAR(found[0].impact.v_after[0], 0.0, 1e-6);
    EXPECT_NEAR(found[0].impact.impulse, 4.0 * std::sin(hit), 1e-3);
  }
}

// A load that pushes the masses apart is no impact, and is known where there is one.
TEST(ImpactFinder, KnowsLoadsAndForces) {
  auto problem = equal_masses();
  problem.system.stiffness.setZero();
  problem.system.add_load = [](double, std::span<double> force) { force[0] += 50.0; };
  const StateAt bounce = [](double t) {
    const double x = t - 0.2;  // turned round at the bottom, u1 = 1e-3 there
    return FreeState{t, Eigen::Vector2d(1e-3 + 25.0 * x * x, 0.0), Eigen::Vector2d(50.0 * x, 0.0)};
  };
  EXPECT_EQ(find_impacts(sampled(bounce, 0.5, 0.011, true), problem).size(), 0u);
  problem.system.add_load = {};
  EXPECT_EQ(find_impacts(sampled(bounce, 0.5, 0.011, true), problem).size(), 1u);
}

TEST(ImpactFinder, HasNothingToFindWithoutAContact) {
  auto problem = masses(1.0, 2.0);
  problem.contacts.clear();
  EXPECT_TRUE(
      find_impacts(sampled(unconstrained_motion(1.0, 2.0, 0.0), 10.0, 0.1, true), problem).empty());
}

TEST(FreeMotion, IsThatOfTheEquationOfMotion) {
  auto problem = masses(1.0, 3.0);
  problem.system.damping << 0.2, -0.1, -0.1, 0.4;
  problem.system.add_load = [](double t, std::span<double> f) { f[1] += 2.0 * t; };
  const FreeMotion motion(problem.system);
  const auto a = motion.acceleration(3.0, Eigen::Vector2d(1.0, 2.0), Eigen::Vector2d(-1.0, 1.0));
  EXPECT_NEAR(a[0], -(-0.2 - 0.1) - 1.0, 1e-15);
  EXPECT_NEAR(a[1], (6.0 - (0.1 + 0.4) - 9.0) / 0.5, 1e-14);
  const auto undamped = masses(1.0, 3.0);
  const FreeMotion free(undamped.system);
  const auto state = unconstrained_motion(1.0, 3.0, 0.4);
  for (const double s : {0.02, -0.02}) {
    const auto to = free.moved(state(1.0), s), reference = state(1.0 + s);
    EXPECT_NEAR((to.u - reference.u).norm(), 0.0, 1e-8);
    EXPECT_NEAR((to.v - reference.v).norm(), 0.0, 3e-8);
    EXPECT_EQ(to.t, 1.0 + s);
  }
}

}  // namespace
}  // namespace clackers::measure
