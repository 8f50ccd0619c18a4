#include "clackers/exact/flights/idle_contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/model/harmonic_load.hpp"

// Contacts that touch at the start without a force.
namespace clackers::exact {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using model::Side;

/// Masses of 1 kg on springs, each in touch with the next.
model::ImpactProblem<> row_of_masses(const VectorXd& stiffness, const VectorXd& start) {
  const auto n = stiffness.size();
  model::ImpactProblem<> problem;
  problem.system.mass = MatrixXd::Identity(n, n);
  problem.system.damping = MatrixXd::Zero(n, n);
  problem.system.stiffness = stiffness.asDiagonal();
  problem.start = {0.0, start, VectorXd::Zero(n)};
  problem.end = 1.5;
  for (Eigen::Index i = 0; i + 1 < n; ++i)
    problem.contacts.push_back({VectorXd::Unit(n, i) - VectorXd::Unit(n, i + 1), 0.0, 0.5});
  return problem;
}

/// Two balls, one on the other, above a floor.
model::ImpactProblem<> falling(double weight) {
  auto problem = row_of_masses(VectorXd::Zero(2), VectorXd::Ones(2));
  problem.contacts[0].direction *= -1.0;
  problem.contacts.push_back({VectorXd::Unit(2, 0), 0.0, 0.5});
  problem.system.add_load = model::HarmonicLoad({{0, -9.81, 0.0, 0.0}, {1, weight, 0.0, 0.0}});
  return problem;
}

TEST(IdleContacts, MassesAtRestStayInTouch) {
  const PiecewiseMotion motion(row_of_masses(Eigen::Vector2d(1.0, 2.0), VectorXd::Zero(2)));
  EXPECT_TRUE(motion.at(1.5, Side::left).u.isZero(0.0));
  ASSERT_EQ(motion.closed_contacts().size(), 1u);
  EXPECT_EQ(motion.contact_forces(1.0, Side::left)[0], 0.0);
}

TEST(IdleContacts, EndAtTheImpactOfANeighbour) {
  auto problem = row_of_masses(Eigen::Vector3d(1.0, 2.0, 3.0), Eigen::Vector3d(1.0, 0.0, 0.0));
  problem.end = 2.0;
  const PiecewiseMotion motion(problem);
  const auto before = motion.at(1.25, Side::left), after = motion.at(2.0, Side::left);
  EXPECT_NEAR(before.u[0], std::cos(1.25), 1e-15);
  EXPECT_TRUE(before.u.tail(2).isZero(0.0));
  ASSERT_GE(motion.impact_count(2.0), 1);
  EXPECT_NEAR(motion.impact(1).t, 0.5 * std::numbers::pi, 1e-15);
  // Newton's law for both contacts: gap rates 0.5 and 0, the momentum of 1 kg.
  EXPECT_NEAR(motion.impact(1).after.v[0], 0.0, 1e-15);
  EXPECT_NEAR(motion.impact(1).after.v[1], -0.5, 1e-15);
  EXPECT_NEAR(motion.impact(1).after.v[2], -0.5, 1e-15);
  EXPECT_LE(after.u[1], 0.0);
}

TEST(IdleContacts, BallsFallTogether) {
  auto problem = falling(-9.81);
  EXPECT_TRUE(is_never_pressed(problem, {true, false, false}, 0));
  EXPECT_FALSE(is_never_pressed(problem, {true, true, false}, 0));
  EXPECT_FALSE(is_never_pressed(falling(std::nextafter(-9.81, 0.0)), {true, false, false}, 0));
  const PiecewiseMotion motion(problem);
  const double t = 0.75, fall = std::sqrt(2.0 / 9.81), s = t - fall;
  const auto now = motion.at(t, Side::left), bound = motion.error_bound(t);
  for (const Eigen::Index i : {0, 1})
    EXPECT_NEAR(now.u[i], s * (0.5 * 9.81 * fall - 0.5 * 9.81 * s), bound.u[i] + 1e-15);
  ASSERT_EQ(motion.closed_contacts().size(), 2u);
  EXPECT_EQ(motion.closed_contacts()[0].contact, 0);
  // Both rest on the floor, like one ball.
  EXPECT_NEAR(motion.closed_contacts()[1].from, 3.0 * fall, 1e-6);
  EXPECT_NEAR(motion.contact_forces(1.5, Side::left)[1], 2.0 * 9.81, 1e-13);
}

TEST(IdleContacts, OfAnyOtherStartAreNotIdle) {
  const std::vector<bool> closed{true, false};
  auto problem = row_of_masses(Eigen::Vector2d(1.0, 2.0), VectorXd::Zero(2));
  EXPECT_TRUE(is_idle_from_start(problem, closed, 0));
  problem.start.u = VectorXd::Constant(2, 0x1p-1070);
  EXPECT_FALSE(is_idle_from_start(problem, closed, 0));
  problem.start.u = Eigen::Vector2d(0.0, 0x1p-1070);
  EXPECT_FALSE(is_idle_from_start(problem, closed, 0));
  // Accelerations and their rates are equal, the next derivatives are not.
  problem.start.u.setZero();
  problem.system.add_load = model::HarmonicLoad({{0, 2.0, 3.0, 0.0}, {1, 2.0, 3.0, 0.0}});
  EXPECT_FALSE(is_idle_from_start(problem, closed, 0));
  EXPECT_REFUSED(PiecewiseMotion{problem}, "not-admissible", "contact 1 is closed at t = 0 s");
  problem.system.stiffness(1, 1) = 1.0;
  EXPECT_TRUE(is_never_pressed(problem, closed, 0));
  EXPECT_TRUE(is_idle_from_start(problem, closed, 0));
  EXPECT_EQ(PiecewiseMotion(problem).closed_contacts().size(), 1u);
}

}  // namespace
}  // namespace clackers::exact
