#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <numbers>

#include "clackers/diagnose/causes.hpp"
#include "clackers/diagnose/testing/ladder_sets.hpp"

// What solvers of others do to forces, events and steps.
namespace clackers::diagnose::testing {
namespace {

constexpr int cause_plans[] = {1, 3, 4};

TEST(ForceStep, IsTheShareOfForcesInDisplacements) {
  for (const int i : cause_plans)
    for (const double share : {0.0, 0.5625, 0.75}) {
      const auto found = ladder_causes(
          files_of(ladder_plan(i), fmt::format("method=forces contact=end-of-step share={}", share))
              .question());
      ASSERT_NE(find(found, "force-step"), nullptr) << i << ' ' << share;
      EXPECT_NEAR(find(found, "force-step")->value, share, 0.03) << i;
    }
}

TEST(ForceStep, IsNoneOfMethodsThatKeepTheEnergyBounded) {
  for (const int i : cause_plans)
    for (const auto* solver :
         {"method=forces share=1", "method=symplectic-euler", "method=newmark", "method=heun",
          "method=implicit-euler", "method=newmark beta=0", "method=rk4 k1*=1.05"})
      EXPECT_EQ(find(ladder_causes(files_of(ladder_plan(i), solver).question()), "force-step"),
                nullptr)
          << i << ' ' << solver;
}

std::vector<Diagnosis> of_tolerances(const LadderPlan& plan, const std::string& solver) {
  Files files{plan.problem};
  for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8})
    files.add(history_of(fmt::format("tolerance={} own-steps jumps {}", tolerance, solver),
                         plan.problem.problem, 0.01),
              tolerance);
  auto question = files.question();
  question.by_tolerance = true;
  return ladder_causes(question);
}

TEST(EventInterpolated, IsFoundOfLinesBetweenSteps) {
  for (const int i : cause_plans) {
    const auto found = of_tolerances(ladder_plan(i), "event-linear");
    ASSERT_NE(find(found, "event-interpolated"), nullptr) << i;
    EXPECT_NEAR(find(found, "event-interpolated")->value, 2.0, 0.7) << i;
    EXPECT_EQ(find(of_tolerances(ladder_plan(i), ""), "event-interpolated"), nullptr) << i;
  }
}

TEST(FixedInternalStep, IsNamedAndDeniesTheLadder) {
  for (const int i : cause_plans) {
    const auto plan = ladder_plan(i);
    const double step = 0.9 * plan.steps.front();
    const auto found =
        diagnose(files_of(plan, fmt::format("method=rk4 internal-step={}", step)).question());
    ASSERT_EQ(codes(found), "fixed-internal-step") << i;
    EXPECT_NEAR(found[0].value, step, 0.02 * step) << i;
    EXPECT_TRUE(denies_ladder(found[0]));
  }
}

// As spheres in MuJoCo: in coarse steps they pass through each other, are pushed apart on the other
// side, and the motion grows.
TEST(ContactInTension, IsNotReadFromMotionsThatHaveGrown) {
  for (const int i : {0, 1, 2}) {
    auto plan = ladder_plan(i);
    const auto& problem = plan.problem.problem;
    const auto& contact = problem.contacts.front();
    const double w = std::numbers::pi / (16.0 * plan.steps.back());
    const double mass =
        1.0 / contact.direction.dot(problem.system.mass.llt().solve(contact.direction));
    const auto spring = fmt::format("method=rk4 spring={}", mass * w * w);
    const auto pulls = spring + fmt::format(" dashpot={}", 0.6 * mass * w);
    for (const double growth : {1.0, 20.0}) {
      Files files{plan.problem};
      for (const double factor : {2.0, 1.8, 1.6, 1.4, 1.2, 1.0}) {
        const double step = factor * plan.steps.back();
        auto rows = history_of(factor > 1.3 ? pulls : spring, problem, step);
        for (auto* column : {&rows.u, &rows.v})
          for (auto& value : *column) value *= factor > 1.3 ? growth : 1.0;
        files.add(rows, step);
      }
      const auto found = ladder_causes(files.question());
      EXPECT_EQ(find(found, "contact-in-tension") != nullptr, growth == 1.0)
          << i << ' ' << growth << ' ' << codes(found);
    }
  }
}

}  // namespace
}  // namespace clackers::diagnose::testing
