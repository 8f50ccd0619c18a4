#include "clackers/measure/impacts/shared_impacts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "clackers/exact/assembly/assemblies.hpp"
#include "clackers/exact/assembly/assembly.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"

namespace clackers::measure {
namespace {

TEST(SharedImpacts, AreThoseOfContactsWithCommonMasses) {
  exact::RowParameters row;
  const auto motion = exact::make_row(row);
  const auto found = shared_instants(*motion, exact::row_problem(row, *motion));
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].contacts, 4);
  EXPECT_NEAR(found[0].t, 1.5707963267948966, 1e-15);
  row.masses = 2.0;
  row.fast = 0.0;
  const auto pair = exact::make_row(row);
  EXPECT_TRUE(shared_instants(*pair, exact::row_problem(row, *pair)).empty());
}

TEST(SharedImpacts, AreNoneOfContactsThatTakeTurnsOrLeaveEachOtherAlone) {
  const auto turns = exact::make_alternating({});
  EXPECT_TRUE(shared_instants(*turns, exact::alternating_problem({}, *turns)).empty());
  const auto pairs = exact::make_assembly({});
  ASSERT_EQ(pairs->impact(1).t, pairs->impact(2).t);
  EXPECT_TRUE(shared_instants(*pairs, exact::assembly_problem({}, *pairs)).empty());
}

// Five balls that touch: one swings against four that are closed.
TEST(SharedImpacts, AreThoseBesideContactsThatAreHeld) {
  model::ImpactProblem<> balls;
  balls.system.mass = balls.system.stiffness = Eigen::MatrixXd::Identity(5, 5);
  balls.system.damping = Eigen::MatrixXd::Zero(5, 5);
  balls.start = {0.0, -Eigen::VectorXd::Unit(5, 0), Eigen::VectorXd::Zero(5)};
  balls.end = 6.0;
  for (int i = 0; i < 4; ++i)
    balls.contacts.push_back(
        {Eigen::VectorXd::Unit(5, i + 1) - Eigen::VectorXd::Unit(5, i), 0.0, 1.0});
  const auto found = shared_instants(exact::PiecewiseMotion(balls), balls);
  ASSERT_EQ(found.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(found[i].contacts, 4);
    EXPECT_NEAR(found[i].t, 1.5707963267948966 * double(2 * i + 1), 1e-14);
  }
}

// The middle one of three balls is struck by the first and strikes the last one a little later.
TEST(SharedImpacts, ClosestImpactsTakePartInEachOther) {
  model::ImpactProblem<> balls;
  balls.system.mass = balls.system.stiffness = Eigen::MatrixXd::Identity(4, 4);
  balls.system.damping = Eigen::MatrixXd::Zero(4, 4);
  balls.start = {0.0, -Eigen::VectorXd::Unit(4, 0), Eigen::VectorXd::Zero(4)};
  balls.end = 4.0;
  const auto add = [&](int i, double gap) {
    balls.contacts.push_back(
        {Eigen::VectorXd::Unit(4, i + 1) - Eigen::VectorXd::Unit(4, i), gap, 1.0});
  };
  add(0, 0.0);
  add(1, -0.001);
  // The second one leaves with a speed of 1, sin(t) = 0.001.
  const exact::PiecewiseMotion motion(balls);
  EXPECT_NEAR(closest_impacts(motion, balls), std::asin(0.001), 1e-12);
  // Neither another impact of the same contact nor a much weaker one counts, nor one between other masses.
  auto light = balls;
  light.system.mass(2, 2) = light.system.stiffness(2, 2) = 0.01;
  const exact::PiecewiseMotion weak(light);
  EXPECT_GE(weak.impact_count(light.end), 2);
  EXPECT_EQ(closest_impacts(weak, light), 0.0);
  balls.contacts.resize(1);
  EXPECT_EQ(closest_impacts(exact::PiecewiseMotion(balls), balls), 0.0);
  balls.end = 8.0;
  add(2, -0.5);
  balls.start.u[2] = -0.2;
  EXPECT_EQ(closest_impacts(exact::PiecewiseMotion(balls), balls), 0.0);
}

TEST(SharedImpacts, ErrorsAreLargestBeforeAndInAsMuchTimeAfter) {
  const std::vector<double> t{0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5};
  // The interval that holds the instant counts on neither side, and the last one is too late.
  const std::vector<std::vector<double>> errors{{1, 2, 9, 4, 0, 3, 8}, {2, 1, 9, 0, 5, 1, 8}};
  const auto at = [&](const std::vector<SharedInstant>& instants) {
    return at_shared_instants(instants, 0.0, t, errors);
  };
  const auto found = at({{3.0, 2}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->error_before, 2.0);
  EXPECT_EQ(found->error_after, 5.0);
  EXPECT_FALSE(at({{0.9, 2}}));
  EXPECT_FALSE(at({{6.0, 2}}));
  EXPECT_FALSE(at({}));
  EXPECT_FALSE(at_shared_instants(std::vector<SharedInstant>{{3.0, 2}}, 0.0, {}, {}));
  // At most until the next one.
  EXPECT_EQ(at({{3.0, 2}, {4.6, 2}})->error_after, 0.0 + 5.0);
  EXPECT_FALSE(at({{3.0, 2}, {4.0, 2}}));
}

TEST(SharedImpacts, AreThoseFromWhichTheErrorComes) {
  const std::vector<double> t{0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5};
  const std::vector<std::vector<double>> errors{{1e-9, 1e-9, 2e-9, 2e-9, 3e-9, 3e-9, 0.4, 0.6}};
  const auto found =
      at_shared_instants(std::vector<SharedInstant>{{2.0, 2}, {5.0, 3}}, 0.0, t, errors);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->instant.t, 5.0);
  EXPECT_EQ(found->instant.contacts, 3);
  EXPECT_EQ(found->error_before, 2e-9);
  EXPECT_EQ(found->error_after, 0.6);
}

}  // namespace
}  // namespace clackers::measure
