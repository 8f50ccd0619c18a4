#include "clackers/report/columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "clackers/report/testing/sample_record.hpp"
#include "clackers/report/testing/written.hpp"

namespace clackers::report {
namespace {

using record::Cell;

std::size_t position(const record::Sheet& sheet, std::string_view name) {
  const auto at = std::ranges::find(sheet.columns, name, &record::Column::name);
  EXPECT_NE(at, sheet.columns.end()) << name;
  return std::size_t(at - sheet.columns.begin());
}

Cell cell(const record::Sheet& sheet, std::size_t row, std::string_view name) {
  return sheet.rows.at(row).at(position(sheet, name));
}

TEST(Columns, NamesAreDifferentAndEveryOneHasAMeaning) {
  std::set<std::string_view> names;
  for (const auto& shown : columns()) {
    EXPECT_TRUE(names.insert(shown.name).second) << shown.name;
    EXPECT_FALSE(shown.meaning.empty() || shown.heading.empty()) << shown.name;
  }
  EXPECT_THROW(column("no-such-column"), std::logic_error);
}

TEST(Columns, ListHasEveryColumnOfCsv) {
  const auto listed = list_columns();
  for (const auto& of_csv : run_sheet(sample_record().cases, false).columns)
    EXPECT_TRUE(std::ranges::any_of(listed.rows, [&](const auto& row) {
      return row.front() == Cell(of_csv.name);
    })) << of_csv.name;
}

TEST(RunSheet, ARowARunAndOneForASubjectWithoutRuns) {
  const auto record = sample_record();
  const auto sheet = run_sheet(record.cases);
  // Six methods with 8 x 8 runs, three levels of the interrupted one, one refused.
  EXPECT_EQ(sheet.rows.size(), 6u * 64 + 24 + 1);
  for (const auto& row : sheet.rows) EXPECT_EQ(row.size(), sheet.columns.size());
  EXPECT_EQ(cell(sheet, 0, "case"), Cell("three-parameter"));
  EXPECT_EQ(cell(sheet, 0, "method"), Cell("newmark"));
  EXPECT_EQ(cell(sheet, 8, "level"), Cell(2LL));
  EXPECT_EQ(cell(sheet, 8, "step"), Cell(0.025));
  EXPECT_EQ(cell(sheet, 8, "steps_per_fast_period"), Cell(1.2582 / 0.025));
  const auto last = sheet.rows.size() - 1;
  EXPECT_EQ(cell(sheet, last, "verdict"), Cell("refused"));
  EXPECT_EQ(cell(sheet, last, "refusal_code"), Cell("penalty-needs-elastic"));
  for (const auto name : {"behaviour", "step", "u_error", "steps", "seconds", "failure", "file"})
    EXPECT_EQ(cell(sheet, last, name), Cell()) << name;
}

TEST(RunSheet, EveryNumberOfARunIsInItsColumn) {
  auto record = sample_record();
  auto& run = record.cases[0].subjects[0].levels[0].runs[0].score;
  run = {.step = 1,
         .finished = true,
         .failure_code = {},
         .failure = {},
         .u_error = 2,
         .u_error_absolute = 3,
         .v_error = 4,
         .energy_error = 5,
         .energy_ratio = 6,
         .rounding_floor = 7,
         .impacts = measure::ImpactScore{8, 9, 10, 11, 12, 13},
         .work = {14, 15, 16, 17, 18},
         .seconds = 19};
  const auto sheet = run_sheet(record.cases);
  double next = 2;
  for (const auto name :
       {"u_error", "u_error_absolute", "v_error", "energy_error", "energy_ratio", "rounding_floor"})
    EXPECT_EQ(cell(sheet, 0, name), Cell(next++)) << name;
  for (const auto name :
       {"impacts_expected", "impacts_found", "impacts_matched", "impacts_missed", "impacts_extra"})
    EXPECT_EQ(cell(sheet, 0, name), Cell(static_cast<long long>(next++))) << name;
  EXPECT_EQ(cell(sheet, 0, "impact_time_error"), Cell(next++));
  for (const auto name :
       {"steps", "force_evaluations", "factorizations", "newton_iterations", "event_searches"})
    EXPECT_EQ(cell(sheet, 0, name), Cell(static_cast<long long>(next++))) << name;
  EXPECT_EQ(cell(sheet, 0, "seconds"), Cell(next++));
}

TEST(RunSheet, ARunThatFailedHasItsWorkAndNoErrors) {
  auto record = sample_record();
  auto& run = record.cases[0].subjects[0].levels[0].runs[0].score;
  run.finished = false;
  run.failure_code = "diverged";
  run.failure = "left the finite numbers";
  const auto sheet = run_sheet(record.cases);
  for (const auto name : {"u_error", "v_error", "impacts_found", "impact_time_error"})
    EXPECT_EQ(cell(sheet, 0, name), Cell()) << name;
  EXPECT_EQ(cell(sheet, 0, "steps"), Cell(400LL));
  EXPECT_EQ(cell(sheet, 0, "finished"), Cell("no"));
  EXPECT_EQ(cell(sheet, 0, "failure_code"), Cell("diverged"));
}

TEST(RunSheet, HistoriesHaveTheirFileAndNoWork) {
  const auto record = sample_check();
  const auto sheet = run_sheet(record.cases);
  ASSERT_EQ(sheet.rows.size(), 2u);
  EXPECT_EQ(cell(sheet, 1, "file"), Cell("fine.csv"));
  EXPECT_EQ(cell(sheet, 1, "rows"), Cell(2001LL));
  EXPECT_EQ(cell(sheet, 1, "digits"), Cell("6"));
  EXPECT_EQ(cell(sheet, 1, "u_error"), Cell(0.001));
  for (const auto name : {"v_error", "steps", "seconds"})
    EXPECT_EQ(cell(sheet, 1, name), Cell()) << name << ": not measured";
}

TEST(RunSheet, MetricsAreThoseOfAllRuns) {
  auto record = sample_check();
  auto& levels = record.cases[0].subjects[0].levels;
  levels[0].runs[0].metrics.clear();  // the coarsest history does not have all displacements
  levels[1].runs[0].metrics.resize(2);
  const auto sheet = run_sheet(record.cases);
  EXPECT_EQ(cell(sheet, 0, "metric:u-max"), Cell());
  EXPECT_EQ(cell(sheet, 1, "metric:u-max"), Cell(1e-6));
  EXPECT_EQ(cell(sheet, 1, "metric:v-max"), Cell(2.0));
  EXPECT_EQ(run_sheet(record.cases, false).columns.size() + 2, sheet.columns.size());
}

TEST(SummaryTable, ImpactsAreMatchedOverExact) {
  auto record = sample_record();
  for (auto& run : record.cases[0].subjects[0].levels.back().runs)
    run.score.impacts = measure::ImpactScore{6, 6, 5, 1, 1, 1e-3};
  const auto table = summary_table(record.cases[0], record::SubjectKind::method);
  EXPECT_EQ(column("impacts").get(table.rows[0]), Cell("5/6"));
}

TEST(SummaryTable, TheWorstOfTheFinestLevelThatRanIsShown) {
  auto record = sample_record();
  auto& subject = record.cases[0].subjects[4];
  auto& runs = subject.levels.back().runs;
  runs[3].score.u_error = 0.7;
  runs[6].score.finished = false;
  runs[6].score.u_error = 99.0;
  subject.levels.push_back({1e-6, {}});  // interrupted before its first run
  const auto row = subject_row(record.cases[0], subject);
  EXPECT_EQ(column("u_error").get(row), Cell(0.7));
  EXPECT_EQ(column("step").get(row), Cell(0.05 / 128));
}

TEST(Columns, ARunOfALadderOfTolerancesHasAToleranceAndNoStep) {
  auto record = sample_record();
  auto& problem = record.cases[0];
  auto& subject = problem.subjects[0];
  const auto& run = subject.levels[1].runs[0];
  const auto row = run_row(problem, subject, 2, run);
  EXPECT_EQ(column("step").get(row), Cell(run.score.step));
  EXPECT_EQ(column("tolerance").get(row), Cell());
  subject.refined_by = record::RefinementParameter::tolerance;
  EXPECT_EQ(column("step").get(row), Cell());
  EXPECT_EQ(column("tolerance").get(row), Cell(run.score.step));
}

}  // namespace
}  // namespace clackers::report
