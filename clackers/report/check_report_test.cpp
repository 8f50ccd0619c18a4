#include "clackers/report/check_report.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "clackers/report/check_words.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/sample_check.hpp"

namespace clackers::report {
namespace {

using nlohmann::json;

std::string written(Format format, const study::CheckRecord& what = sample_check(),
                    Style style = {}) {
  std::ostringstream out;
  write(what, format, out, style);
  return out.str();
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(CheckTable, FitsItsWidth) {
  auto longest = sample_check();
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
  const auto painted = written(Format::table, sample_check(), {.color = true, .width = 80});
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
  auto partial = sample_check();
  partial.files.pop_back();
  partial.files[0].score.impacts.reset();
  partial.files[0].metrics.clear();
  const auto text = written(Format::csv, partial);
  EXPECT_TRUE(text.ends_with(",,,,,,\n")) << text;
}

TEST(CheckJson, HoldsEverythingUnderItsSchema) {
  auto full = sample_check();
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

TEST(CheckWords, TellDigitsOfDisplacementsAndSinglePrecision) {
  study::CheckedFile file;
  EXPECT_EQ(digits_text(file), "0");
  file.columns = {
      {"t", 17, true, 0.0}, {"u1", 6, false, 0.0}, {"v1", 12, true, 0.0}, {"u2", 9, false, 0.0}};
  EXPECT_EQ(most_digits(file), 9);
  EXPECT_EQ(digits_text(file), "9") << "t and v do not count";
  file.columns[1].single = true;
  EXPECT_EQ(digits_text(file), "single");
}

}  // namespace
}  // namespace clackers::report
