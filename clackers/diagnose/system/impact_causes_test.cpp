#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "clackers/diagnose/system/measured_causes.hpp"
#include "clackers/diagnose/testing/ladder_sets.hpp"
#include "clackers/diagnose/testing/method_rows.hpp"

// Solvers of first order, as physics engines are, whose displacements hide what their impacts show.
namespace clackers::diagnose::testing {
namespace {

constexpr int law_plans[] = {0, 3, 4};
constexpr auto first_order = "method=symplectic-euler contact=end-of-step";

double restitution(const LadderPlan& plan) {
  return plan.problem.problem.contacts.front().restitution;
}

bool slows_down(const LadderPlan& plan) { return restitution(plan) < 1.0; }

std::vector<Diagnosis> causes_of(const LadderPlan& plan, const std::string& solver,
                                 double eta_share = 1.0) {
  auto solved = plan.problem.problem;
  solved.contacts.front().restitution *= eta_share;
  auto files = files_of(plan, solver, solved);
  files.fit();
  return impact_causes(files.question());
}

TEST(ImpactCauses, AThresholdIsFoundBetweenTheSpeedsOfImpacts) {
  for (const int i : law_plans) {
    const auto plan = ladder_plan(i);
    if (!slows_down(plan)) continue;
    const auto& motion = *plan.problem.motion;
    const double speed = 0.5 * plan.problem.problem.contacts[0].gap_rate(
                                   -motion.at(motion.impact(1).t, model::Side::left).v);
    for (const auto* method : {"method=symplectic-euler", "method=newmark"}) {
      const auto found =
          causes_of(plan, fmt::format("{} contact=end-of-step bounces-above={}", method, speed));
      ASSERT_NE(find(found, "restitution-threshold"), nullptr) << i << ' ' << method;
      const auto& cause = *find(found, "restitution-threshold");
      EXPECT_EQ(cause.unit, "m/s");
      EXPECT_NEAR(cause.value, speed, 1.02 * cause.fact("uncertainty"));
      EXPECT_TRUE(is_other_system(cause));
      EXPECT_EQ(find(found, "restitution-differs"), nullptr) << i << ' ' << method;
    }
  }
}

TEST(ImpactCauses, OverlapThatIsPushedOutIsAGainForEachStep) {
  for (const int i : {1, 5, 9})
    for (const double share : {0.1, 0.3}) {
      const auto found =
          causes_of(ladder_plan(i), fmt::format("{} pushed-out={}", first_order, share));
      ASSERT_EQ(codes(found), "energy-gained-at-impacts") << i << ' ' << share;
      EXPECT_NEAR(found[0].value, share, 0.1 * share) << i;
    }
}

TEST(ImpactCauses, RestitutionIsMeasuredInHistoriesOfFirstOrder) {
  for (const int i : law_plans)
    for (const auto* method : {"method=symplectic-euler", "method=euler", "method=newmark"}) {
      const auto plan = ladder_plan(i);
      const auto found = causes_of(plan, std::string(method) + " contact=end-of-step", 0.8);
      ASSERT_EQ(codes(found), "restitution-differs") << i << ' ' << method;
      EXPECT_NEAR(found[0].value, 0.8 * restitution(plan), 0.01) << i << ' ' << method;
      EXPECT_EQ(found[0].fact("expected"), restitution(plan));
    }
}

TEST(ImpactCauses, RestitutionThatDependsOnThePlaceInTheStepScatters) {
  int found = 0, all = 0;
  for (const int i : {1, 3, 5}) {
    const auto causes = causes_of(ladder_plan(i), std::string(first_order) + " eta-lost-late=0.3");
    EXPECT_TRUE(codes(causes) == "restitution-scatters" || causes.empty()) << i << codes(causes);
    ++all;
    found += !causes.empty();
  }
  EXPECT_GE(2 * found, all);
}

TEST(ImpactCauses, OneHistoryShowsItsRestitution) {
  for (const int i : law_plans) {
    auto plan = ladder_plan(i);
    plan.steps = {plan.steps.back()};
    const auto found = causes_of(plan, "method=newmark", 0.97);
    ASSERT_EQ(codes(found), "restitution-differs") << i;
    EXPECT_NEAR(found[0].value, 0.97 * restitution(plan), 0.002) << i;
  }
}

TEST(ImpactCauses, RightSolversHaveNone) {
  for (const int i : law_plans)
    for (const auto* solver :
         {first_order, "method=implicit-euler contact=end-of-step", "method=euler",
          "method=newmark contact=start-of-step", "method=newmark beta=0.3025 gamma=0.6",
          "method=rk4 contact=linear", "contact=moreau", "method=rk4 event-tolerance=1e-3"}) {
      auto plan = ladder_plan(i);
      EXPECT_EQ(codes(causes_of(plan, solver)), "") << i << ' ' << solver;
      for (const double step : ladder_plan(i).steps) {
        plan.steps = {step};
        EXPECT_EQ(codes(causes_of(plan, solver)), "") << i << ' ' << solver << " h = " << step;
      }
    }
}

// Rows of equal spacing on the straight lines between those of a solver.
model::Trajectory resampled(const model::Trajectory& rows, int count) {
  model::Trajectory on_grid;
  on_grid.dof = rows.dof;
  const auto dof = std::size_t(rows.dof);
  for (int k = 0; k <= count; ++k) {
    const double t = rows.t.back() * k / count;
    const auto next = std::max<std::ptrdiff_t>(
        1, std::min(std::ranges::upper_bound(rows.t, t) - rows.t.begin(), std::ssize(rows.t) - 1));
    const auto i = std::size_t(next) - 1;
    const double x = (t - rows.t[i]) / (rows.t[i + 1] - rows.t[i]);
    on_grid.t.push_back(t);
    for (const auto& [from, to] : {std::pair{&rows.u, &on_grid.u}, std::pair{&rows.v, &on_grid.v}})
      for (auto j = i * dof; j < (i + 1) * dof; ++j)
        to->push_back((1.0 - x) * (*from)[j] + x * (*from)[j + dof]);
  }
  return on_grid;
}

TEST(ImpactCauses, RowsInterpolatedAcrossImpactsShowNoRestitution) {
  for (const int i : law_plans)
    for (const int count : {1100, 1500, 1900}) {
      const auto plan = ladder_plan(i);
      Files files{plan.problem};
      for (const double step : plan.steps) {
        const auto rows = resampled(history_of("method=rk4", plan.problem.problem, step), count);
        files.add(rows, facts_of(plan.problem, rows, step));
      }
      files.fit();
      EXPECT_EQ(codes(impact_causes(files.question())), "") << i << ' ' << count;
    }
}

TEST(ImpactCauses, SlowImpactsDoNotHideWhatFastOnesMeasure) {
  for (const double share : {0.9375, 1.0}) {
    Files files{cases::make("ball")};
    auto solved = files.problem.problem;
    solved.contacts[0].restitution *= share;
    for (int k = 0; k < 8; ++k) {
      const double step = 0.0237 * std::exp2(-0.5 * k);
      files.add(run("moreau-jean", solved, step), step);
    }
    files.fit();
    const auto found = impact_causes(files.question());
    ASSERT_EQ(codes(found), share < 1.0 ? "restitution-differs" : "");
    if (share == 1.0) continue;
    EXPECT_NEAR(found[0].value, 0.75, 0.005);
  }
}

TEST(ImpactCauses, OneOfManyContactsShowsItsRestitutionInTwoHistories) {
  for (const double eta : {0.95, 1.0}) {
    Files files{cases::make("row")};
    auto solved = files.problem.problem;
    solved.contacts[1].restitution = eta;
    for (const double step : {0.0327, 0.0164, 0.0082, 0.0041})
      files.add(run("rk4", solved, step), step);
    files.fit();
    const auto found = impact_causes(files.question());
    ASSERT_EQ(codes(found), eta < 1.0 ? "restitution-differs" : "");
    if (eta == 1.0) continue;
    EXPECT_NEAR(found[0].value, eta, 1e-4);
    EXPECT_EQ(found[0].fact("contact"), 2.0);
  }
}

}  // namespace
}  // namespace clackers::diagnose::testing
