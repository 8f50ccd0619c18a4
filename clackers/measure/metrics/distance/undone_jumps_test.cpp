#include "clackers/measure/metrics/definitions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

using std::numbers::pi;
const ToyMotion jump_reference(12.0);
const auto jump_problem = toy_problem(12.0);

// The reference until pi/2, then on through the contact until it turns 0.1 s later: its
// displacement is -cos t until then, and that of the reference 0.1 s ago from there on.
model::Trajectory history_with_late_impacts() {
  auto history = history_of(jump_reference, {0.0, 1.0, 1.6, pi / 2, pi / 2, 3.0});
  history.t[3] = history.t[4] = pi / 2 + 0.1;
  const double v = -std::sin(history.t[3]), turned = std::cos(0.1);
  history.u = {
      1.0, -0.5, std::cos(1.0), -0.5 * std::cos(1.0), std::cos(1.6), -0.5 * std::cos(1.6), 0.0, 0.0,
      0.0, 0.0,  std::cos(0.1), -0.5 * std::cos(0.1)};
  history.v = {
      0.0, 0.0,      -std::sin(1.0), 0.5 * std::sin(1.0), -std::sin(1.6), 0.5 * std::sin(1.6),
      v,   -0.5 * v, turned,         -0.5 * turned,       std::sin(2.9),  -0.5 * std::sin(2.9)};
  history.impacts = {{history.t[3], 0, {}, {}, {}, 2.0}};
  return history;
}

TEST(UnfoldedVelocity, ForgetsOnWhichSideOfAJumpAMotionIs) {
  const auto found =
      unfolded_velocity_error({history_with_late_impacts(), jump_reference, jump_problem});
  ASSERT_EQ(found.reason, "");
  EXPECT_NEAR(found.masses[0], std::abs(std::sin(3.0) - std::sin(2.9)), 1e-14);
  EXPECT_NEAR(found.masses[1], 0.5 * std::abs(std::sin(3.0) - std::sin(2.9)), 1e-14);
}

TEST(UnfoldedVelocity, CountsAMissedImpactForGood) {
  auto history = history_with_late_impacts();
  history.impacts->clear();
  // Both limits in two rows: the left one is right now, the right one off by both.
  EXPECT_NEAR(unfolded_velocity_error({history, jump_reference, jump_problem}).value,
              2.0 * std::cos(0.1), 1e-14);
}

TEST(UnfoldedVelocity, TakesARowAloneAtAnImpactForTheSideBehindIt) {
  auto history = history_of(jump_reference, {0.0, pi / 2, 3.0});
  history.impacts = {{pi / 2, 0, {}, {}, {}, 2.0}};
  EXPECT_LE(unfolded_velocity_error({history, jump_reference, jump_problem}).value, 1e-15);
}

TEST(UnfoldedVelocity, OfAHistoryThatStartsLateCountsFromThere) {
  auto history = history_of(jump_reference, {2.0, 3.0, 3 * pi / 2, 3 * pi / 2, 6.0});
  history.impacts = {{3 * pi / 2, 0, {}, {}, {}, 2.0}};
  EXPECT_LE(unfolded_velocity_error({history, jump_reference, jump_problem}).value, 1e-15);
}

class Passing : public ToyMotion {
 public:
  model::MotionImpact impact(long long index) const override {
    auto found = ToyMotion::impact(index);
    found.after.v[1] = 0.25;
    return found;
  }
};

TEST(UnfoldedVelocity, IsDefinedWhereAnImpactReversesAll) {
  const auto reason = [](const model::Motion& motion, const model::ImpactProblem<>& problem) {
    return unfolded_velocity_error({history_of(motion, {0.0, 1.0}), motion, problem}).reason;
  };
  auto lossy = jump_problem, two = jump_problem;
  lossy.contacts[0].restitution = 0.9;
  two.contacts.push_back(two.contacts[0]);
  EXPECT_EQ(reason(jump_reference, jump_problem), "");
  EXPECT_NE(reason(jump_reference, lossy).find("restitution 1"), std::string::npos);
  EXPECT_NE(reason(jump_reference, two).find("one contact"), std::string::npos);
  EXPECT_NE(reason(Passing(), toy_problem()).find("some pass"), std::string::npos);
}

TEST(JumpInvariantDistance, LaysOneSideOfAJumpOntoTheOther) {
  // Displacements differ by cos(pi/2 + 0.1) and its like, relative to (1, 1/2); velocities by no
  // more once J has been applied.
  const auto history = history_with_late_impacts();
  double expected = std::abs(2.0 * std::cos(1.6));  // row 2, on the wrong side
  expected = std::max(expected, std::sin(0.1));     // at the jump
  expected = std::max(expected, std::abs(std::sin(3.0) - std::sin(2.9)));
  EXPECT_NEAR(jump_invariant_distance({history, jump_reference, jump_problem}).value, expected,
              1e-14);
}

// Restitution 1/2, relative velocity r* = -3 sin(1) / 2: states without momentum with r = -2 r* are
// mapped onto the reference, those with r = -r*/2 are its image.
TEST(JumpInvariantDistance, KnowsWhichSideIsWhich) {
  auto lossy = jump_problem;
  lossy.contacts[0].restitution = 0.5;
  const double s = std::sin(1.0);
  for (const double v : {2.0 * s, 0.5 * s, -s}) {
    auto history = history_of(jump_reference, {0.0, 1.0});
    history.v[2] = v;
    history.v[3] = -0.5 * v;
    EXPECT_NEAR(jump_invariant_distance({history, jump_reference, lossy}).value, 0.0, 1e-15) << v;
    EXPECT_GT(jump_invariant_distance({history, jump_reference, jump_problem}).value,
              v < 0.0 ? -1.0 : 0.4);
  }
}

TEST(JumpInvariantDistance, IsRelativeToTheEnvelopesAndTakesTheWorst) {
  auto history = history_of(jump_reference, {0.0, 1.0, 1.2});
  history.v[3] += 0.1;
  history.u[5] -= 0.02;
  EXPECT_NEAR(jump_invariant_distance({history, jump_reference, jump_problem}).value, 0.2, 1e-15);
  history.v[3] -= 0.1;
  EXPECT_NEAR(jump_invariant_distance({history, jump_reference, jump_problem}).value, 0.04, 1e-15);
}

TEST(JumpInvariantDistance, TriesEveryContact) {
  auto both = jump_problem;
  both.contacts.insert(both.contacts.begin(), {Eigen::Vector2d(1.0, 0.0), -9.0, 1.0});
  auto history = history_of(jump_reference, {0.0, 1.0});
  history.v[2] *= -1.0;  // mass 1 alone, as a stop would
  EXPECT_NEAR(jump_invariant_distance({history, jump_reference, both}).value, 0.0, 1e-15);
  history.v[3] *= -1.0;  // both, as they do to each other
  EXPECT_NEAR(jump_invariant_distance({history, jump_reference, both}).value, 0.0, 1e-15);
}

TEST(JumpInvariantDistance, SaysWhyItIsNotMeasured) {
  auto history = history_of(jump_reference, {0.0, 1.0});
  auto free = jump_problem;
  free.contacts.clear();
  EXPECT_EQ(jump_invariant_distance({history, jump_reference, free}).reason,
            "The problem has no contact.");
  history.v.clear();
  EXPECT_EQ(jump_invariant_distance({history, jump_reference, jump_problem}).reason,
            "The history has no velocities.");
}

}  // namespace
}  // namespace clackers::measure
