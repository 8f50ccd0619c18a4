#include "clackers/diagnose/observation.hpp"

#include <gtest/gtest.h>

#include "clackers/diagnose/testing/histories.hpp"

namespace clackers::diagnose {
namespace {

using testing::exact_rows;
using testing::observed;

TEST(Observation, KeepsEveryRowOfAShortHistory) {
  const auto problem = cases::make("three-parameter");
  const auto rows = exact_rows(problem, 0.02);
  const auto seen = observed(problem, rows, 0.02);
  EXPECT_EQ(seen.rows, 1001);
  EXPECT_EQ(seen.sample.t, rows.t);
  EXPECT_EQ(seen.sample.u, rows.u);
  EXPECT_EQ(seen.opening.v, rows.v);
  ASSERT_EQ(seen.sample_steps.size(), 1001u);
  EXPECT_EQ(seen.sample_steps[700], 700);
  EXPECT_EQ(seen.sample.impacts->size(), 6u);
  EXPECT_FALSE(seen.impacts_reported);
}

TEST(Observation, SpreadsItsSampleOverALongHistory) {
  const auto problem = cases::make("three-parameter");
  const auto rows = exact_rows(problem, 0.0005);
  const auto seen = observed(problem, rows, 0.0005);
  ASSERT_EQ(seen.sample.t.size(), most_sample_rows);
  EXPECT_EQ(seen.opening.t.size(), most_opening_rows);
  EXPECT_EQ(seen.sample.t.front(), 0.0);
  EXPECT_EQ(seen.sample.t.back(), rows.t.back());
  for (std::size_t i = 1; i < most_sample_rows; ++i)
    EXPECT_NEAR(seen.sample.t[i] - seen.sample.t[i - 1], 20.0 / 1499.0, 0.0006);
}

TEST(Observation, LeavesLimitsOfJumpsOut) {
  const auto problem = cases::make("three-parameter");
  auto rows = exact_rows(problem, 0.02);
  rows.t.insert(rows.t.begin() + 79, {1.5707, 1.5707});
  for (auto* values : {&rows.u, &rows.v})
    values->insert(values->begin() + 158, {0.0, 0.0, 0.0, 0.0});
  const auto seen = observed(problem, rows, 0.02);
  EXPECT_EQ(seen.rows, 1003);
  EXPECT_EQ(seen.sample.t.size(), 1001u);
  EXPECT_EQ(seen.sample_steps.back(), 1000);
}

// A row at an event stands between two places of the grid.
TEST(Observation, CountsTheGridPastRowsOfEvents) {
  const auto problem = cases::make("sdof");
  auto rows = exact_rows(problem, 0.02);
  rows.t.insert(rows.t.begin() + 79, 1.57);
  rows.u.insert(rows.u.begin() + 79, rows.u[78]);
  rows.v.insert(rows.v.begin() + 79, rows.v[78]);
  const auto seen = observed(problem, rows, 0.02);
  EXPECT_EQ(seen.sample_steps[79], -1);
  EXPECT_EQ(seen.sample_steps[80], 79);
  EXPECT_EQ(seen.sample_steps.back(), 1000);
}

// (omega h)^4 / 30 of the fastest mass is 5e-4 at h = 0.04, N = 2 (omega about 9); velocities half a
// step away differ by a h / 2, about omega h / 2 of their envelope, 0.18.
TEST(Observation, ComparesVelocitiesWithTheRateOfDisplacements) {
  for (const auto& problem : testing::assorted_cases()) {
    auto rows = exact_rows(problem, 0.02);
    const double right = observed(problem, rows, 0.02).velocity_mismatch;
    testing::resample(rows, problem, 0.0, 0.01);
    EXPECT_LT(right, 1e-2);
    EXPECT_GT(observed(problem, rows, 0.02).velocity_mismatch, 5.0 * right);
  }
  auto rows = exact_rows(cases::make("stop"), 0.02);
  rows.v.clear();
  EXPECT_TRUE(std::isnan(observed(cases::make("stop"), rows, 0.02).velocity_mismatch));
}

}  // namespace
}  // namespace clackers::diagnose
