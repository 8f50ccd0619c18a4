#include <gtest/gtest.h>

#include "clackers/measure/metrics/definitions.hpp"
#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

const ToyMotion moved_reference;

model::Impact impact(double t, double before, double after) {
  return {t, 0, {0.0, 0.0}, {before, 0.0}, {after, 0.0}, 0.0};
}

TEST(Restitution, IsThatOfTheGapRatesAtImpacts) {
  auto history = history_of(moved_reference, {0.0, 0.1, 0.2, 0.3, 1.5, 2.5, 3.0});
  history.impacts = {impact(0.5, -2.0, 1.0), impact(1.5, -1.0, 0.8), impact(2.5, -0.1, 0.0)};
  const auto problem = toy_problem();
  const Comparison comparison(history, moved_reference, problem);
  EXPECT_DOUBLE_EQ(restitution_median(comparison).value, 0.5);
  EXPECT_EQ(restitution_smallest(comparison).value, 0.0);
}

TEST(Restitution, IsNotMeasuredWithoutImpacts) {
  auto history = history_of(moved_reference, {0.0, 1.0});
  history.impacts.emplace();
  EXPECT_FALSE(restitution_median({history, moved_reference, toy_problem()}).reason.empty());
}

// Masses 1 and 2, stiffnesses 1 and 2, no damping; u = (1, -1/2) and v = 0 at the start: a = (-1, 1/2).
TEST(ForceShare, IsThatOfTheFirstStep) {
  const double h = 0.1;
  for (const double share : {0.0, 0.625, 1.0}) {
    auto history = history_of(moved_reference, {0.0, h, 2 * h});
    history.u[2] = 1.0 - share * h * h;
    history.u[3] = -0.5 + share * h * h / 2.0;
    EXPECT_NEAR(first_force_share({history, moved_reference, toy_problem()}).value, share, 1e-12);
  }
}

TEST(ForceShare, IsNotMeasuredWithoutVelocitiesOrInContact) {
  auto history = history_of(moved_reference, {0.0, 0.1});
  history.u[2] = history.u[3] = 0.0;
  EXPECT_NE(first_force_share({history, moved_reference, toy_problem()}).reason.find("contact"),
            std::string::npos);
  history.v.clear();
  EXPECT_NE(first_force_share({history, moved_reference, toy_problem()}).reason.find("velocities"),
            std::string::npos);
}

}  // namespace
}  // namespace clackers::measure
