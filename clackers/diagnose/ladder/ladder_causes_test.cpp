#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <numbers>
#include <string>

#include "clackers/diagnose/causes.hpp"
#include "clackers/diagnose/ladder/impact_location.hpp"
#include "clackers/diagnose/testing/ladder_sets.hpp"
#include "clackers/diagnose/testing/method_rows.hpp"

namespace clackers::diagnose::testing {
namespace {

std::string listed(const std::vector<Diagnosis>& all) {
  std::string text;
  for (const auto& one : all) text += one.code + " = " + std::to_string(one.value) + "; ";
  return text;
}

// Every test runs on plans of other systems, steps and numbers of files.
class LadderCauses : public ::testing::TestWithParam<int> {
 protected:
  LadderPlan plan = ladder_plan(GetParam());

  Diagnosis only(const Files& files, std::string_view code) const {
    const auto all = ladder_causes(files.question());
    const auto* found = find(all, code);
    EXPECT_TRUE(found) << listed(all);
    // Some of the steps may be commensurate by accident.
    EXPECT_EQ(all.size(), find(all, "commensurate-steps") ? 2u : 1u) << listed(all);
    return found ? *found : Diagnosis{};
  }
  void expect_nothing(const std::string& solver) const {
    const auto all = ladder_causes(files_of(plan, solver).question());
    EXPECT_TRUE(all.empty()) << listed(all);
  }
};
INSTANTIATE_TEST_SUITE_P(Plans, LadderCauses, ::testing::Range(0, 20));

TEST_P(LadderCauses, CorrectRungeKuttaHasNone) { expect_nothing("method=rk4"); }

TEST_P(LadderCauses, CorrectNewmarkHasNone) { expect_nothing("method=newmark"); }

TEST_P(LadderCauses, ImplicitEulerHasNone) { expect_nothing("method=implicit-euler"); }

TEST_P(LadderCauses, ExactFlightsAndImpactsHaveNone) { expect_nothing("method=exact"); }

TEST_P(LadderCauses, SecondOrderLocationDoesNotLimitNewmark) {
  expect_nothing("method=newmark contact=linear");
}

TEST_P(LadderCauses, AnotherRestitutionIsAWrongLimit) {
  auto problem = plan.problem.problem;
  problem.contacts.front().restitution *= 0.95;
  const auto files = files_of(plan, "method=newmark", problem);
  const auto found = only(files, "wrong-limit");
  // The distance is that of the finest history but for its own error.
  const double error = files.ladder.back().runs.back().u_error;
  EXPECT_NEAR(found.value, error, 0.2 * error);
  EXPECT_NEAR(found.fact("order"), 2.0, 0.3);
}

TEST_P(LadderCauses, AnotherStiffnessIsAWrongLimit) {
  auto problem = plan.problem.problem;
  problem.system.stiffness *= 1.02;
  only(files_of(plan, "method=rk4", problem), "wrong-limit");
}

TEST_P(LadderCauses, AFaultThatBeginsLateIsRightUntilItsImpact) {
  const auto late = only(files_of(plan, "method=rk4 at=2 impulse-at=1.2"), "wrong-limit");
  EXPECT_EQ(late.fact("impact"), 2.0);
  EXPECT_EQ(late.fact("time"), plan.problem.motion->impact(2).t);
  const auto early = only(files_of(plan, "method=rk4 c*=1.1"), "wrong-limit");
  EXPECT_TRUE(std::isnan(early.fact("impact")));
}

TEST_P(LadderCauses, ImpactsAtTheEndOfStepsAreLateByHalfAStepInTheMean) {
  for (const std::string method : {"exact", "newmark"}) {
    const auto found =
        only(files_of(plan, "method=" + method + " contact=end-of-step"), "impact-at-step-end");
    EXPECT_EQ(found.text, "end");
    // Five uniform numbers have a mean within 0.13 of 0.5 in two cases of three.
    EXPECT_NEAR(found.value, 0.5, 0.49);
  }
}

TEST_P(LadderCauses, AnAccelerationThatIsNotRenewedLacksInTheNextStep) {
  for (const std::string where : {"after impacts", "at the start"}) {
    const auto* word = where == "at the start" ? " a0-zero" : " stale";
    const auto found =
        only(files_of(plan, std::string("method=newmark") + word), "acceleration-not-renewed");
    EXPECT_EQ(found.text, where);
    EXPECT_NEAR(found.value, 0.5, 0.02) << where;
  }
}

TEST_P(LadderCauses, ImpactsAtTheStartOfStepsAreEarly) {
  const auto found =
      only(files_of(plan, "method=newmark contact=start-of-step"), "impact-at-step-end");
  EXPECT_EQ(found.text, "start");
  EXPECT_NEAR(found.value, -0.5, 0.49);
}

TEST_P(LadderCauses, LinearInterpolationLimitsRungeKutta) {
  const auto found = only(files_of(plan, "method=rk4 contact=linear"), "impact-interpolated");
  EXPECT_NEAR(found.value, 2.0, 0.7);
}

TEST_P(LadderCauses, ToleranceOfTheSearchForImpactsIsMeasured) {
  const double tolerance = plan.steps.back() / 50.0;
  const auto found =
      only(files_of(plan, fmt::format("method=rk4 event-tolerance={} event-share=1", tolerance)),
           "impact-tolerance");
  // The upper end of an interval at most as long as the tolerance and more than half of it.
  EXPECT_LE(found.value, tolerance);
  EXPECT_GE(found.value, 0.1 * tolerance);
}

TEST_P(LadderCauses, OneGapAtImpactsOfOtherDelaysIsNoTolerance) {
  auto late = plan.problem.problem;
  const double gap = -0.003 * plan.problem.motion->peak().u.maxCoeff();
  late.contacts.front().gap += gap;
  for (const std::size_t count : {std::size_t(5), std::size_t(1)}) {
    auto halved = plan;
    halved.steps.resize(count);
    for (std::size_t k = 0; k < count; ++k) halved.steps[k] = plan.steps[2] * std::exp2(-double(k));
    const auto files = files_of(halved, "method=rk4", late);
    EXPECT_EQ(limit_of(files.histories, plan.problem.problem, *plan.problem.motion).wrong,
              count > 1);
    const auto all = ladder_causes(files.question());
    const auto* found = find(all, "gap-differs");
    ASSERT_TRUE(found) << count << ' ' << listed(all);
    EXPECT_NEAR(found->value, gap, 0.01 * std::abs(gap)) << count;
    EXPECT_EQ(is_other_system(*found), count > 1);
    EXPECT_FALSE(find(all, "impact-at-step-end")) << listed(all);
    EXPECT_FALSE(find(all, "impact-tolerance")) << listed(all);
  }
}

TEST_P(LadderCauses, AnImpactThroughWhichMassesFlyOnIsMissed) {
  const auto all = ladder_causes(files_of(plan, "method=rk4 miss=2").question());
  const auto* found = find(all, "impact-missed");
  ASSERT_TRUE(found) << listed(all);
  EXPECT_EQ(found->value, 2.0);
  EXPECT_EQ(found->fact("time"), plan.problem.motion->impact(2).t);
}

TEST_P(LadderCauses, WhiteNoiseIsAFloor) {
  const auto files = files_of(plan, "method=rk4 noise=1e-5");
  const auto found = only(files, "noise-floor");
  EXPECT_EQ(found.value, files.ladder.back().runs.back().u_error);
}

TEST_P(LadderCauses, ADashpotThatPullsIsContactInTension) {
  const double duration = 16.0 * plan.steps.back();
  const auto& problem = plan.problem.problem;
  const auto& contact = problem.contacts.front();
  const Eigen::VectorXd push = problem.system.mass.llt().solve(contact.direction);
  const double mass = 1.0 / contact.direction.dot(push), w = std::numbers::pi / duration;
  // At the end of a contact of damping ratio 0.3 only the dashpot acts.
  const auto solver = fmt::format("method=rk4 spring={} dashpot={}", mass * w * w, 0.6 * mass * w);
  auto fine = plan;
  fine.steps.assign(plan.steps.end() - 2, plan.steps.end());
  const auto all = ladder_causes(files_of(fine, solver).question());
  EXPECT_TRUE(find(all, "contact-in-tension")) << listed(all);
}

TEST_P(LadderCauses, MassesThatPassThroughEachOtherAreNotInTension) {
  const auto all = ladder_causes(files_of(plan, "method=rk4 no-contact").question());
  EXPECT_FALSE(find(all, "contact-in-tension")) << listed(all);
}

TEST_P(LadderCauses, StepsThatDivideTheTimesOfImpactsAreNamed) {
  const auto& motion = *plan.problem.motion;
  // Impacts at odd multiples of the first one's time: whole parts of it have all on steps.
  const double first = motion.impact(1).t;
  auto with_luck = plan;
  for (auto k = 0u; k < with_luck.steps.size(); k += 3)
    with_luck.steps[k] = first / std::round(first / with_luck.steps[k]);
  const auto all = ladder_causes(
      files_of(with_luck, "method=exact contact=end-of-step clearance=-1e-9").question());
  const auto* found = find(all, "commensurate-steps");
  ASSERT_TRUE(found) << listed(all);
  // Others may be so by accident.
  EXPECT_GE(found->value, plan.steps.size() == 5 ? 0.4 : 1.0 / 3.0);
  EXPECT_LE(found->value, 0.6);
}

TEST_P(LadderCauses, FailedCoarseRunsAreAStabilityLimit) {
  auto files = files_of(plan, "method=newmark");
  const auto failed = std::size_t(1 + GetParam() % 3);
  for (std::size_t i = 0; i < failed; ++i) {
    auto& run = files.ladder[i].runs.front();
    run.u_error = 1e6;
    if (GetParam() % 2 == 0) {
      run.finished = false;
      run.failure_code = "diverged";
    }
  }
  files.histories.erase(files.histories.begin(), files.histories.begin() + std::ptrdiff_t(failed));
  const auto found = only(files, "unstable-coarse-steps");
  EXPECT_EQ(found.value, plan.steps[failed]);
  EXPECT_EQ(found.fact("step"), plan.steps[failed - 1]);
}

TEST_P(LadderCauses, EnergyLossOfRunsWithoutHistoriesIsDamping) {
  auto files = files_of(plan, "method=newmark");
  files.histories.clear();
  const double order = 1.0 + 0.5 * (GetParam() % 3);
  for (auto& level : files.ladder)
    level.runs.front().energy_ratio = 1.0 - 0.02 * std::pow(level.step / plan.steps.back(), order);
  const auto found = only(files, "numerical-damping");
  EXPECT_NEAR(found.value, 0.02, 1e-12);
  EXPECT_NEAR(found.fact("order"), order, 1e-9);
}

TEST(ImpactTolerance, IsNotReadFromTwoImpactsBetweenTwoRows) {
  const auto problem = cases::make("pressed-oscillator", {{"f1", 0.3}});
  Files files{problem};
  for (int k = 3; k <= 10; ++k) {
    const double tolerance = std::pow(10.0, -k);
    model::Trajectory rows;
    rows.dof = 1;
    for (int i = 0; i <= 2000; ++i) {
      const double t = 0.01 * i;
      const auto state = problem.motion->at(t, model::Side::right);
      rows.t.push_back(t);
      rows.u.push_back(state.u[0] + 0.1 * tolerance * std::sin(t));
      rows.v.push_back(state.v[0] + 0.1 * tolerance * std::cos(t));
    }
    files.add(rows, facts_of(problem, rows, tolerance));
  }
  auto question = files.question();
  question.by_tolerance = true;
  const auto found = ladder_causes(question);
  EXPECT_EQ(find(found, "impact-tolerance"), nullptr) << listed(found);
  // Delays are counted in rows.
  for (const auto& impact : locate_impacts(files.histories.back(), problem.problem, true).impacts)
    EXPECT_LT(std::abs(impact.delay_steps), 1.0);
}

TEST(CommensurateSteps, AreNoneWhereImpactsAreLocatedAndErrorsFallAlongALine) {
  for (const std::string contact : {"", "+reversal"}) {
    Files files{cases::make("forced-pair")};
    for (const double step : {0.05, 0.025, 0.0125, 0.00625, 0.003125, 0.0015625})
      files.add(run("newmark" + contact, files.problem.problem, step), step);
    files.fit();
    const auto found = ladder_causes(files.question());
    EXPECT_EQ(find(found, "commensurate-steps") != nullptr, !contact.empty()) << listed(found);
  }
}

}  // namespace
}  // namespace clackers::diagnose::testing
