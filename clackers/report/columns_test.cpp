#include "clackers/report/runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "clackers/report/sample_record.hpp"
#include "clackers/report/write.hpp"
#include "clackers/study/verify.hpp"

namespace clackers::report {
namespace {

std::size_t column(const study::Sheet& sheet, std::string_view name) {
  const auto at = std::ranges::find(sheet.columns, name, &study::Column::name);
  EXPECT_NE(at, sheet.columns.end()) << name;
  return std::size_t(at - sheet.columns.begin());
}

TEST(Runs, AreOneRowEachAndOneForAMethodWithoutRuns) {
  const auto sheet = runs(sample_record());
  // Six whole ladders of 8 x 8, three levels of the interrupted method, one refused.
  EXPECT_EQ(sheet.rows.size(), 6u * 64 + 24 + 1);
  for (const auto& row : sheet.rows) EXPECT_EQ(row.size(), sheet.columns.size());
  EXPECT_EQ(sheet.rows[0][column(sheet, "method")], study::Cell("newmark"));
  EXPECT_EQ(sheet.rows[8][column(sheet, "level")], study::Cell(2LL));
  EXPECT_EQ(sheet.rows[8][column(sheet, "step")], study::Cell(0.025));
  EXPECT_EQ(sheet.rows[8][column(sheet, "steps_per_fast_period")], study::Cell(1.2582 / 0.025));
}

TEST(Runs, CarryEveryNumberOfTheRunInItsColumn) {
  auto record = sample_record();
  auto& run = record.methods[0].ladder[0].runs[0];
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
         .impacts = {},
         .work = {14, 15, 16, 17, 18},
         .seconds = 19};
  run.impacts = assess::ImpactScore{8, 9, 10, 11, 12, 13};
  const auto sheet = runs(record);
  double next = 2;
  for (const auto name :
       {"u_error", "u_error_absolute", "v_error", "energy_error", "energy_ratio", "rounding_floor"})
    EXPECT_EQ(sheet.rows[0][column(sheet, name)], study::Cell(next++)) << name;
  for (const auto name : {"collisions_expected", "collisions_found", "collisions_matched",
                          "collisions_missed", "collisions_extra"})
    EXPECT_EQ(sheet.rows[0][column(sheet, name)], study::Cell(static_cast<long long>(next++)))
        << name;
  EXPECT_EQ(sheet.rows[0][column(sheet, "collision_time_error")], study::Cell(next++));
  for (const auto name :
       {"steps", "force_evaluations", "factorizations", "newton_iterations", "event_searches"})
    EXPECT_EQ(sheet.rows[0][column(sheet, name)], study::Cell(static_cast<long long>(next++)))
        << name;
  EXPECT_EQ(sheet.rows[0][column(sheet, "seconds")], study::Cell(next));
}

TEST(Runs, LeaveEmptyWhatWasNotMeasured) {
  auto record = sample_record();
  auto& first = record.methods[0].ladder[0];
  first.runs[0].finished = false;
  first.runs[0].failure_code = "diverged";
  first.runs[0].failure = "left the range of finite numbers at t = 3 s";
  first.runs[1].impacts.reset();
  first.runs[2].impacts = assess::ImpactScore{6, 0, 0, 6, 0, 0.0};
  const auto sheet = runs(record);
  const auto empty = study::Cell();
  EXPECT_EQ(sheet.rows[0][column(sheet, "u_error")], empty);
  EXPECT_EQ(sheet.rows[0][column(sheet, "collisions_found")], empty);
  EXPECT_EQ(sheet.rows[0][column(sheet, "failure_code")], study::Cell("diverged"));
  EXPECT_EQ(sheet.rows[1][column(sheet, "collisions_found")], empty);
  EXPECT_NE(sheet.rows[1][column(sheet, "u_error")], empty);
  EXPECT_EQ(sheet.rows[2][column(sheet, "collisions_found")], study::Cell(0LL));
  EXPECT_EQ(sheet.rows[2][column(sheet, "collision_time_error")], empty);
}

TEST(Runs, MarkInterruptedAndRefusedMethods) {
  const auto sheet = runs(sample_record());
  EXPECT_EQ(sheet.rows[0][column(sheet, "complete")], study::Cell("yes"));
  EXPECT_EQ(sheet.rows[6 * 64][column(sheet, "complete")], study::Cell("no"));
  const auto& refused = sheet.rows.back();
  EXPECT_EQ(refused[column(sheet, "refusal_code")], study::Cell("penalty-needs-elastic"));
  EXPECT_EQ(refused[column(sheet, "verdict")], study::Cell());
  EXPECT_TRUE(
      std::get<std::string>(refused[column(sheet, "failure")]).starts_with("newmark+penalty with"));
}

TEST(Record, IsWrittenAsCsvAndAsTheJsonOfStudy) {
  std::ostringstream csv, json;
  const auto record = sample_record();
  write(record, Format::csv, csv);
  write(record, Format::json, json);
  EXPECT_TRUE(csv.str().starts_with("method,complete,behaviour,verdict,refusal_code,level,step,"));
  EXPECT_EQ(json.str(), study::to_json(record) + "\n");
}

}  // namespace
}  // namespace clackers::report
