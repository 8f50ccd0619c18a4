#include "clackers/report/check_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "clackers/report/format.hpp"

namespace clackers::report {
namespace {

using nlohmann::json;

study::CheckedFile file(const std::string& name, double step) {
  study::CheckedFile made;
  made.file = name;
  made.rows = 2001;
  made.spacing = step;
  made.last = 20.0;
  made.columns = {{"t", 17, false, 0.0}, {"u1", 6, false, 5e-6}};
  made.printed_floor = 5e-6;
  made.printed_by = "u1";
  made.has_u = {true, true};
  made.collisions = study::CollisionSource::history;
  made.score.step = step;
  made.score.finished = true;
  made.score.u_error = 0.1 * step;
  made.score.v_error = std::nan("");
  made.score.impacts = assess::ImpactScore{6, 5, 4, 2, 1, 0.125, 0.0};
  made.metrics = {{"u-max", "m", 0.25, {0.25, 0.125}, "", true},
                  {"v-max", "m/s", 2.0, {}, "", false},
                  {"a-max", "m/s2", std::nan(""), {}, "There are no accelerations.", true},
                  {"impacts-missed", "1", 2.0, {}, "", true}};
  made.notes = {"No events file: they were found in the history itself."};
  return made;
}

study::CheckRecord record() {
  study::CheckRecord made;
  made.problem.name = "three-parameter";
  made.problem.end = 20.0;
  made.problem.fast_period = 0.7;
  made.problem.impact_count = 6;
  made.files = {file("/a/long/way/to/coarse.csv", 0.02), file("fine.csv", 0.01)};
  made.files.front().notes.push_back("The first row is at 0.02 s, not at the start.");
  auto& fit = made.assessment.displacement;
  fit.behaviour = Behaviour::undecided;
  fit.reason = "too-few-levels";
  made.verdict = Verdict::disagrees;
  made.sentence = "It finds 4 of 6 collisions.";
  made.reason = "too-few-levels";
  made.next = "clackers explain too-few-levels";
  return made;
}

std::string written(Format format, const study::CheckRecord& what = record(), Style style = {}) {
  std::ostringstream out;
  write(what, format, out, style);
  return out.str();
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(CheckTable, FitsItsWidth) {
  auto longest = record();
  longest.files.front().file = std::string(100, 'x') + ".csv";
  longest.next = std::string(100, 'y');
  for (const int width : {40, 80, 120}) {
    std::istringstream lines(written(Format::table, longest, {.color = false, .width = width}));
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(display_width(line), std::size_t(width)) << line;
  }
}

TEST(CheckTable, HasARowAFileWithWhatWasMeasured) {
  const auto text = written(Format::table);
  EXPECT_TRUE(has(text, "coarse.csv 2001 0.02      6 2.0e-3     -   5/6       4 1.2e-1\n")) << text;
  EXPECT_FALSE(has(text, "/a/long/way"));
}

TEST(CheckTable, HasTheMetricsOfTheFinestFile) {
  const auto text = written(Format::table);
  EXPECT_TRUE(has(text, "u-max          2.50e-1 m    2.50e-1  1.25e-1\n")) << text;
  EXPECT_TRUE(has(text, "v-max *        2.00e0  m/s\n") ||
              has(text, "v-max *         2.00e0 m/s\n"))
      << text;
  EXPECT_TRUE(has(text, "* need not tend to zero"));
  EXPECT_TRUE(has(text, "impacts-missed       2 1\n")) << text;
  EXPECT_TRUE(has(text, "Not measured: a-max"));
}

TEST(CheckTable, SaysEachKindOfNoteOnce) {
  const auto text = written(Format::table);
  const auto at = text.find("found in the history itself");
  EXPECT_NE(at, std::string::npos);
  EXPECT_EQ(text.find("found in the history itself", at + 1), std::string::npos);
  EXPECT_TRUE(has(text, "coarse.csv: The first row is at 0.02 s")) << text;
}

TEST(CheckTable, EndsWithTheVerdictAndTheNextCommand) {
  const auto text = written(Format::table);
  EXPECT_TRUE(has(text, "2 histories: undecided [too-few-levels]\n"));
  EXPECT_TRUE(has(text, "It finds 4 of 6 collisions. [too-few-levels]\n"));
  EXPECT_TRUE(text.ends_with("Verdict: disagrees. Next: clackers explain too-few-levels\n"))
      << text;
  const auto painted = written(Format::table, record(), {.color = true, .width = 80});
  EXPECT_TRUE(has(painted, "\x1b["));
}

TEST(CheckCsv, HasARowAFileAndAColumnAMetric) {
  std::istringstream lines(written(Format::csv));
  std::string head, first, second, none;
  std::getline(lines, head);
  std::getline(lines, first);
  std::getline(lines, second);
  EXPECT_FALSE(std::getline(lines, none));
  EXPECT_TRUE(head.starts_with("file,rows,step,step_source,spacing"));
  EXPECT_TRUE(head.ends_with("metric:u-max,metric:v-max,metric:a-max,metric:impacts-missed"));
  EXPECT_EQ(
      second,
      "fine.csv,2001,0.01,data,0.01,0,20,6,5e-06,0.001,0,,0,history,6,5,4,2,1,0.125,0.25,2,,2");
  EXPECT_EQ(std::ranges::count(head, ','), std::ranges::count(first, ','));
}

TEST(CheckCsv, LeavesEmptyWhatWasNotJudged) {
  auto partial = record();
  partial.files.pop_back();
  partial.files[0].score.impacts.reset();
  partial.files[0].metrics.clear();
  const auto text = written(Format::csv, partial);
  EXPECT_TRUE(text.ends_with(",,,,,,\n")) << text;
}

TEST(CheckJson, HoldsEverythingUnderItsSchema) {
  auto full = record();
  full.expect = Claim{Behaviour::proper, 2.0, {}};
  full.files[0].score.u_error = std::numeric_limits<double>::infinity();
  const auto read = json::parse(written(Format::json, full));
  EXPECT_EQ(read["schema"], "clackers/check/1");
  EXPECT_EQ(read["verdict"], "disagrees");
  EXPECT_EQ(read["expect"]["behaviour"], "proper");
  EXPECT_TRUE(read["tolerance"].is_null());
  ASSERT_EQ(read["files"].size(), 2u);
  const auto& one = read["files"][1];
  EXPECT_EQ(one["score"]["u_error"], 0.001);
  EXPECT_EQ(one["score"]["v_error"], "nan");
  EXPECT_EQ(read["files"][0]["score"]["u_error"], "inf");
  EXPECT_EQ(one["collision_source"], "history");
  EXPECT_EQ(one["columns"][1]["digits"], 6);
  EXPECT_EQ(one["metrics"][0]["masses"][1], 0.125);
  EXPECT_EQ(one["metrics"][2]["reason"], "There are no accelerations.");
  EXPECT_EQ(one["has_displacement"], json({true, true}));
}

}  // namespace
}  // namespace clackers::report
