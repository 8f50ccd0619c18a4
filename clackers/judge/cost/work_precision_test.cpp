#include "clackers/judge/cost/work_precision.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "clackers/base/error.hpp"

namespace clackers::judge {
namespace {

measure::RunScore run(double step, long long steps, double error) {
  measure::RunScore made;
  made.step = step;
  made.finished = true;
  made.u_error = error;
  made.v_error = 10.0 * error;
  made.work = {.steps = steps,
               .force_evaluations = 2 * steps,
               .factorizations = 1,
               .newton_iterations = 0,
               .event_searches = 6};
  made.seconds = 1e-6 * double(steps);
  return made;
}

measure::RunScore failed(double step, long long steps) {
  auto made = run(step, steps, 1e-9);
  made.finished = false;
  made.failure_code = "diverged";
  return made;
}

// Three levels of two runs: by hand, errors 4 3 | 1 2 | 0.5 0.25.
measure::Ladder three_levels() {
  return {{0.4, {run(0.4, 10, 4.0), run(0.3, 14, 3.0)}},
          {0.2, {run(0.2, 20, 1.0), run(0.15, 28, 2.0)}},
          {0.1, {run(0.1, 40, 0.5), run(0.075, 56, 0.25)}}};
}

TEST(WorkPrecision, EveryCounterIsReadFromItsField) {
  auto one = run(0.1, 7, 1.0);
  one.work = {1, 2, 3, 4, 5};
  one.seconds = 6.0;
  std::set<std::string_view> names;
  double expected = 0.0;
  for (const auto counter : all_counters) {
    EXPECT_EQ(cost(one, counter), ++expected);
    EXPECT_TRUE(names.insert(to_string(counter)).second) << to_string(counter);
  }
  EXPECT_EQ(to_string(Counter::newton_iterations), "Newton iterations");
  EXPECT_EQ(to_string(Counter::event_searches), "event searches");
}

TEST(WorkPrecision, ACurveHasEveryRunInTheOrderOfItsWork) {
  const auto curve = work_curve(three_levels(), Counter::force_evaluations);
  ASSERT_EQ(curve.runs.size(), 6u);
  const double work[] = {20, 28, 40, 56, 80, 112}, error[] = {4, 3, 1, 2, 0.5, 0.25};
  const bool front[] = {true, true, true, false, true, true};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(curve.runs[i].work, work[i]);
    EXPECT_EQ(curve.runs[i].error, error[i]);
    EXPECT_EQ(curve.runs[i].on_front, front[i]) << i;
  }
  EXPECT_EQ(curve.runs[3].step, 0.15);
}

TEST(WorkPrecision, OfEqualWorkTheSmallerErrorIsOnTheFrontAndTwinsBothAre) {
  const measure::Ladder same{
      {0.1, {run(0.1, 10, 2.0), run(0.1, 10, 1.0), run(0.1, 10, 1.0), run(0.05, 20, 1.0)}}};
  const auto curve = work_curve(same, Counter::steps);
  const double error[] = {1, 1, 2, 1};
  const bool front[] = {true, true, false, false};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(curve.runs[i].error, error[i]);
    EXPECT_EQ(curve.runs[i].on_front, front[i]) << i;
  }
}

TEST(WorkPrecision, TheEnvelopeIsTheWorstOfEachLevel) {
  const auto curve = work_curve(three_levels(), Counter::steps);
  ASSERT_EQ(curve.envelope.size(), 3u);
  const double step[] = {0.4, 0.2, 0.1}, work[] = {14, 28, 56}, error[] = {4, 2, 0.5};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(curve.envelope[i].step, step[i]);
    EXPECT_EQ(curve.envelope[i].work, work[i]);
    EXPECT_EQ(curve.envelope[i].error, error[i]);
  }
}

TEST(WorkPrecision, FailedRunsAreCountedAndLeftOutOfTheEnvelope) {
  auto ladder = three_levels();
  ladder[1].runs[1] = failed(0.15, 900);
  ladder[0].runs[0].u_error = HUGE_VAL;
  ladder[2].runs = {failed(0.1, 9)};
  const auto curve = work_curve(ladder, Counter::steps);
  EXPECT_EQ(curve.runs.size(), 2u);
  EXPECT_EQ(curve.envelope[0].failed, 1);
  EXPECT_EQ(curve.envelope[0].error, 3.0);
  EXPECT_EQ(curve.envelope[1].failed, 1);
  EXPECT_EQ(curve.envelope[1].error, 1.0);
  EXPECT_EQ(curve.envelope[1].work, 20.0);
  EXPECT_TRUE(std::isnan(curve.envelope[2].error));
}

TEST(WorkPrecision, NegativeErrorIsRefused) {
  EXPECT_THROW(work_curve({{0.1, {run(0.1, 1, -1.0)}}}, Counter::steps), InputError);
}

TEST(WorkPrecision, AnErrorIsReachedWhereAllFinerLevelsReachItToo) {
  const auto curve = work_curve(three_levels(), Counter::steps);
  EXPECT_EQ(work_for(curve, 4.0), 14.0);
  EXPECT_EQ(work_for(curve, 3.9), 28.0);
  EXPECT_EQ(work_for(curve, 2.0), 28.0);
  EXPECT_EQ(work_for(curve, 1.9), 56.0);
  EXPECT_EQ(work_for(curve, 0.5), 56.0);
  EXPECT_EQ(work_for(curve, 0.49), std::nullopt);
  EXPECT_THROW(work_for(curve, 0.0), InputError);
}

TEST(WorkPrecision, AFailureBehindACoarseSuccessIsNotPassedOver) {
  auto ladder = three_levels();
  ladder[1].runs[0] = failed(0.2, 3);
  EXPECT_EQ(work_for(work_curve(ladder, Counter::steps), 10.0), 56.0);
  ladder[2].runs[0] = failed(0.1, 3);
  EXPECT_EQ(work_for(work_curve(ladder, Counter::steps), 10.0), std::nullopt);
}

TEST(WorkPrecision, TheLeastWorkCountsWhereACoarserLevelCostsMore) {
  auto ladder = three_levels();
  for (auto& one : ladder[1].runs) one.work.steps = 100;
  EXPECT_EQ(work_for(work_curve(ladder, Counter::steps), 2.0), 56.0);
}

}  // namespace
}  // namespace clackers::judge
