#include "clackers/diagnose/ladder/sanity.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "clackers/diagnose/testing/ladder_sets.hpp"

namespace clackers::diagnose::testing {
namespace {

constexpr int plans = 10;

std::string code_of(const std::optional<Diagnosis>& found) { return found ? found->code : ""; }

TEST(NoLadder, CorrectAndWrongSolversAreLadders) {
  for (int i = 0; i < plans; ++i)
    for (const char* solver :
         {"method=rk4", "method=newmark", "method=exact", "method=rk4 k1*=1.01"})
      EXPECT_EQ(code_of(no_ladder(files_of(ladder_plan(i), solver).question())), "")
          << i << ' ' << solver;
}

// Their states do not depend on the step either, but for roundings.
TEST(NoLadder, ExactFlightsOfAnotherSystemAreThoseOfThatSystem) {
  for (int i = 0; i < plans; ++i) {
    const auto causes = diagnose(files_of(ladder_plan(i), "method=exact c*=1.02").question());
    ASSERT_EQ(codes(causes), "damping-differs") << i;
    EXPECT_TRUE(is_other_system(causes.front())) << i;
  }
}

TEST(NoLadder, OneHistoryUnderSeveralStepsShowsNoEffectOfTheStep) {
  for (int i = 0; i < plans; ++i) {
    const auto plan = ladder_plan(i);
    const auto rows = history_of("method=rk4", plan.problem.problem, plan.steps.front());
    Files files{plan.problem};
    for (const double step : plan.steps) files.add(rows, step);
    EXPECT_EQ(code_of(no_ladder(files.question())), "step-without-effect") << i;
    const auto causes = diagnose(files.question());
    ASSERT_EQ(codes(causes), "step-without-effect") << i;
    EXPECT_TRUE(denies_ladder(causes.front()));
  }
}

TEST(NoLadder, OneToleranceOnFinerGridsShowsNoEffectOfTheStep) {
  for (int i = 0; i < plans; ++i) {
    const auto plan = ladder_plan(i);
    const auto found = [&](const std::vector<double>& spacings) {
      Files files{plan.problem};
      for (const double spacing : spacings)
        files.add(history_of(fmt::format("tolerance=1e-6 spacing={}", spacing),
                             plan.problem.problem, 0.02),
                  spacing);
      return code_of(no_ladder(files.question()));
    };
    EXPECT_EQ(found({0.02, 0.01, 0.005, 0.0025}), "step-without-effect") << i;
    // Grids of these numbers of rows have their end in common.
    std::vector<double> spacings;
    for (const int rows : {503, 601, 719, 853, 1013, 1201, 1433, 1699, 2017, 2399, 2851, 3391})
      spacings.push_back(plan.problem.motion->end() / rows);
    EXPECT_EQ(found(spacings), "step-without-effect") << i;
  }
}

TEST(NoLadder, StepsInTheReverseOrderOfTheFilesContradictTheirRows) {
  for (int i = 0; i < plans; ++i) {
    const auto plan = ladder_plan(i);
    Files files{plan.problem};
    const auto n = plan.steps.size();
    for (std::size_t k = 0; k < n; ++k)
      files.add(history_of("method=rk4", plan.problem.problem, plan.steps[n - 1 - k]),
                plan.steps[k]);
    EXPECT_EQ(code_of(no_ladder(files.question())), "steps-contradict-rows") << i;
  }
}

// Errors C h^2 times `scatter` to the power of a number between -1 and 1.
measure::Ladder line(double scatter) {
  measure::Ladder ladder;
  for (int i = 0; i < 12; ++i) {
    measure::RunScore run;
    run.step = 0.1 * std::exp2(-0.5 * i);
    run.finished = true;
    run.u_error = run.step * run.step * std::pow(scatter, std::sin(7.0 * i));
    run.rounding_floor = 1e-14;
    ladder.push_back({run.step, {run}});
  }
  return ladder;
}

TEST(OddRun, IsTheOneFarAboveTheLineOfAllOthers) {
  for (std::size_t odd = 1; odd < 12; ++odd) {
    auto ladder = line(1.05);
    ladder[odd].runs[0].u_error *= 30.0;
    const auto found = odd_run(ladder);
    ASSERT_TRUE(found) << odd;
    EXPECT_EQ(found->level, odd);
    EXPECT_NEAR(found->found.value, 30.0, 3.0);
    EXPECT_EQ(found->found.fact("step"), ladder[odd].runs[0].step);
    EXPECT_NE(sentence_of(found->found).find(", h = "), std::string::npos);
    EXPECT_NE(sentence_of(odd_run(ladder, true)->found).find(", tolerance = "), std::string::npos);
  }
}

TEST(OddRun, IsNoneOnLinesThatScatterBendOrHaveTwo) {
  EXPECT_FALSE(odd_run(line(1.0)));
  EXPECT_FALSE(odd_run(line(3.0)));
  auto two = line(1.05), small = two, floor = two, coarsest = two;
  // Steps before the line begins.
  coarsest[0].runs[0].u_error *= 30.0;
  EXPECT_FALSE(odd_run(coarsest));
  two[3].runs[0].u_error *= 30.0;
  two[8].runs[0].u_error *= 30.0;
  EXPECT_FALSE(odd_run(two));
  small[4].runs[0].u_error *= 3.0;
  EXPECT_FALSE(odd_run(small));
  for (auto& level : floor) level.runs[0].u_error = std::max(level.runs[0].u_error, 1e-3);
  EXPECT_FALSE(odd_run(floor));
}

}  // namespace
}  // namespace clackers::diagnose::testing
