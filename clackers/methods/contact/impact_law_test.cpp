#include "clackers/methods/contact/impact_law.hpp"

#include <gtest/gtest.h>

namespace clackers::methods {
namespace {

model::ImpactProblem<> chain() {
  model::ImpactProblem<> problem;
  problem.system.mass = Eigen::MatrixXd(3, 3);
  problem.system.mass << 2, 0.5, 0, 0.5, 1, 0, 0, 0, 3;
  problem.system.damping = problem.system.stiffness = Eigen::MatrixXd::Zero(3, 3);
  problem.contacts = {{Eigen::Vector3d(1, -1, 0), 0.0, 0.6},
                      {Eigen::Vector3d(0, 1, -1), 0.1, 1.0},
                      {Eigen::Vector3d(0, 0, 1), 0.0, 1.0}};
  problem.start = {0.0, Eigen::Vector3d(3, 2, 1), Eigen::Vector3d::Zero()};
  problem.end = 1.0;
  return problem;
}

TEST(ImpactLaw, ReversesTheRateByTheRestitutionWithAnImpulseAlongTheRow) {
  const auto problem = chain();
  const auto laws = impact_laws(problem);
  const Eigen::VectorXd before = Eigen::Vector3d(-1.0, 0.5, 0.25);
  Eigen::VectorXd after = before;
  const double impulse = laws[0].apply(after);
  const auto& b = problem.contacts[0].direction;
  EXPECT_NEAR(b.dot(after), -0.6 * b.dot(before), 1e-15);
  EXPECT_GT(impulse, 0.0);
  EXPECT_LT((problem.system.mass * (after - before) - impulse * b).norm(), 1e-15);
}

TEST(ImpactLaw, KeepsTheEnergyOfAnElasticImpact) {
  const auto problem = chain();
  const auto laws = impact_laws(problem);
  Eigen::VectorXd v = Eigen::Vector3d(-1.0, 0.5, 2.25);
  const double before = v.dot(problem.system.mass * v);
  laws[1].apply(v);
  EXPECT_NEAR(v.dot(problem.system.mass * v), before, 1e-14);
}

TEST(ImpactLaw, KnowsWhichContactsAreCoupled) {
  const auto laws = impact_laws(chain());
  EXPECT_TRUE(are_coupled(laws[0], laws[1]));
  EXPECT_TRUE(are_coupled(laws[1], laws[2]));
  EXPECT_FALSE(are_coupled(laws[0], laws[2]));
}

TEST(ImpactLaw, RoundingGrowsWithTheTermsOfTheOpening) {
  const auto laws = impact_laws(chain());
  EXPECT_EQ(laws[1].rounding(Eigen::Vector3d(9, 2, -3)), 8 * 0x1p-52 * (2 + 3 + 0.1));
}

TEST(ImpactLaw, ObjectsToCoupledContactsThatAreClosedAtTheStart) {
  auto problem = chain();
  EXPECT_FALSE(objection_to_closed_contacts("who", problem));
  problem.start.u = Eigen::Vector3d(2, 2, 0);  // contacts 1 and 3, not coupled
  EXPECT_FALSE(objection_to_closed_contacts("who", problem));
  problem.start.u = Eigen::Vector3d(2, 2, 1.9);
  problem.contacts[1].gap = 2 - 1.9;
  const auto no = objection_to_closed_contacts("who", problem);
  ASSERT_TRUE(no);
  EXPECT_EQ(no->code, Code("simultaneous-contacts"));
  EXPECT_EQ(no->sentence,
            "who: t = 0 s: contacts 1 and 2 share a mass and are closed together, which needs a "
            "complementarity solver. Start with one of them open.");
}

}  // namespace
}  // namespace clackers::methods
