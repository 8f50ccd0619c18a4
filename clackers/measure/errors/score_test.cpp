#include "clackers/measure/errors/score.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clackers::measure {
namespace {

RunScore run(double step, double u_error, long long steps, double seconds) {
  RunScore score;
  score.step = step;
  score.finished = true;
  score.u_error = u_error;
  score.v_error = 1.0 / u_error;
  score.work.steps = steps;
  score.seconds = seconds;
  return score;
}

RunScore failed(double step, long long steps) {
  auto score = run(step, HUGE_VAL, steps, 99.0);
  score.finished = false;
  score.failure_code = "diverged";
  score.failure = "The displacement is not finite.";
  return score;
}

TEST(WorstRun, EachNumberIsTheLargestOfTheRunsThatFinished) {
  const RunScore runs[] = {run(0.4, 1.0, 10, 3.0), run(0.3, 4.0, 20, 2.0), failed(0.2, 1000)};
  const auto result = worst(runs);
  EXPECT_TRUE(result.finished);
  EXPECT_EQ(result.step, 0.4);
  EXPECT_EQ(result.u_error, 4.0);
  EXPECT_EQ(result.v_error, 1.0);
  EXPECT_EQ(result.work.steps, 20);
  EXPECT_EQ(result.seconds, 3.0);
  EXPECT_TRUE(result.failure_code.empty());
}

TEST(WorstRun, AFailedFirstRunLeavesItsStepAlone) {
  const RunScore runs[] = {failed(0.4, 1000), run(0.3, 4.0, 20, 2.0)};
  const auto result = worst(runs);
  EXPECT_EQ(result.step, 0.4);
  EXPECT_EQ(result.u_error, 4.0);
  EXPECT_EQ(result.work.steps, 20);
}

TEST(WorstRun, ErrorsAreNaNWhereNoRunFinished) {
  const RunScore runs[] = {failed(0.4, 10), failed(0.3, 20)};
  const auto result = worst(runs);
  EXPECT_FALSE(result.finished);
  EXPECT_EQ(result.failure_code, "diverged");
  EXPECT_TRUE(std::isnan(result.u_error));
  EXPECT_TRUE(std::isnan(result.energy_ratio));
  EXPECT_TRUE(std::isnan(result.seconds));
  EXPECT_EQ(result.work.steps, 0);
  EXPECT_FALSE(result.impacts);
  EXPECT_TRUE(std::isnan(worst({}).u_error));
}

TEST(WorstRun, ANumberThatIsNotFiniteIsTheLargest) {
  const RunScore runs[] = {run(0.4, 1.0, 10, 3.0), run(0.3, NAN, 10, 3.0), run(0.2, 2.0, 10, 3.0)};
  EXPECT_TRUE(std::isnan(worst(runs).u_error));
}

TEST(WorstRun, ImpactsAreThoseWithTheMostMissedAndExtraAndTheLargestTimeError) {
  RunScore runs[] = {run(0.4, 1.0, 10, 3.0), run(0.3, 1.0, 10, 3.0), run(0.2, 1.0, 10, 3.0)};
  runs[1].impacts = ImpactScore{6, 6, 6, 0, 0, 0.5, 1e-12};
  runs[2].impacts = ImpactScore{6, 6, 5, 1, 1, 0.1, 1e-13};
  const auto result = worst(runs);
  ASSERT_TRUE(result.impacts);
  EXPECT_EQ(result.impacts->matched, 5);
  EXPECT_EQ(result.impacts->worst_time_error, 0.5);
  EXPECT_EQ(result.impacts->rounding_floor, 1e-12);
}

TEST(WorstRun, TheEnergyRatioIsTheOneFarthestFromOne) {
  RunScore runs[] = {run(0.4, 1.0, 10, 3.0), run(0.3, 1.0, 10, 3.0)};
  runs[0].energy_ratio = 1.9;
  runs[1].energy_ratio = 0.5;
  EXPECT_EQ(worst(runs).energy_ratio, 0.5);
  runs[1].energy_ratio = 0.6;
  EXPECT_EQ(worst(runs).energy_ratio, 1.9);
}

}  // namespace
}  // namespace clackers::measure
