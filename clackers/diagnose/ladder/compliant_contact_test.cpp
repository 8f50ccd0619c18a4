#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <numbers>

#include "clackers/diagnose/causes.hpp"
#include "clackers/diagnose/testing/ladder_sets.hpp"

// Contacts of a spring instead of an impact law, in histories of elastic systems: a spring gives all
// back.
namespace clackers::diagnose::testing {
namespace {

/// Half a period of the mass that a contact turns back on that spring is `duration`.
double spring_for(const model::ImpactProblem<>& problem, double duration) {
  const auto& direction = problem.contacts.front().direction;
  const Eigen::VectorXd push = problem.system.mass.llt().solve(direction);
  const double w = std::numbers::pi / duration;
  return w * w / direction.dot(push);
}

std::vector<LadderPlan> elastic_plans() {
  std::vector<LadderPlan> plans;
  for (int number = 0; number < 20; ++number)
    if (auto plan = ladder_plan(number); plan.problem.problem.contacts.front().restitution == 1.0)
      plans.push_back(std::move(plan));
  return plans;
}

TEST(CompliantContact, IsNamedWithItsDurationAndStiffness) {
  int all = 0;
  for (const auto& plan : elastic_plans())
    for (const double steps : {8.0, 12.0}) {
      ++all;
      const double duration = steps * plan.steps.back();
      const double spring = spring_for(plan.problem.problem, duration);
      const auto files = files_of(plan, fmt::format("method=rk4 spring={}", spring));
      const auto causes = diagnose(files.question());
      ASSERT_FALSE(causes.empty());
      // Others may be true as well, as a frequency that a coarse method changes.
      ASSERT_EQ(causes[0].code, "contact-compliant") << codes(causes);
      // But for the other springs and for the method's error with so few steps in it.
      EXPECT_NEAR(causes[0].value, duration, 0.05 * duration);
      EXPECT_NEAR(causes[0].fact("stiffness"), spring, 0.1 * spring);
      EXPECT_FALSE(find(causes, "contact-in-tension")) << codes(causes);
    }
  EXPECT_GE(all, 20);
}

TEST(CompliantContact, ThatNoStepResolvesIsNotNamed) {
  for (const auto& plan : elastic_plans()) {
    const double spring = spring_for(plan.problem.problem, 0.5 * plan.steps.back());
    const auto files = files_of(plan, fmt::format("method=rk4 spring={}", spring));
    EXPECT_FALSE(find(ladder_causes(files.question()), "contact-compliant"));
  }
}

}  // namespace
}  // namespace clackers::diagnose::testing
