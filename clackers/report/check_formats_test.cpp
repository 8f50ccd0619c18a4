#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "clackers/report/check_report.hpp"
#include "clackers/report/check_study.hpp"
#include "clackers/report/sample_check.hpp"

namespace clackers::report {
namespace {

std::string written(Format format, const study::CheckRecord& record = sample_check()) {
  std::ostringstream out;
  write(record, format, out);
  return out.str();
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

study::CheckRecord alone(Verdict verdict) {
  auto record = sample_check();
  record.files.erase(record.files.begin());
  record.verdict = verdict;
  return record;
}

TEST(CheckJunit, IsOneTestThatFailsWithTheSentence) {
  const auto text = written(Format::junit);
  EXPECT_TRUE(has(text,
                  "<testsuites name=\"clackers check\" tests=\"1\" failures=\"1\" "
                  "errors=\"0\" skipped=\"0\""));
  EXPECT_TRUE(has(text,
                  "<testcase name=\"2 histories down to fine.csv\" "
                  "classname=\"clackers.check.three-parameter\""));
  EXPECT_TRUE(has(text,
                  "<failure message=\"It finds 4 of 6 collisions. [too-few-levels]\" "
                  "type=\"too-few-levels\">"));
  EXPECT_TRUE(has(text, "fine.csv: h = 0.01 s, error in u 1.00e-3, 4 of 6 collisions\n"));
  EXPECT_TRUE(has(text, "No events file: they were found in the history itself.\n"));
}

TEST(CheckJunit, HasWhatWasMeasuredAsProperties) {
  auto record = sample_check();
  record.tolerance = 0.25;
  record.expect = Claim{Behaviour::proper, 2.0, {}};
  const auto text = written(Format::junit, record);
  EXPECT_TRUE(has(text, "<property name=\"verdict\" value=\"disagrees\"/>"));
  EXPECT_TRUE(has(text, "<property name=\"expect\" value=\"proper, order 2\"/>"));
  EXPECT_TRUE(has(text, "<property name=\"tolerance\" value=\"0.25\"/>"));
  EXPECT_TRUE(has(text, "<property name=\"u_error\" value=\"0.001\"/>"));
  EXPECT_TRUE(has(text, "<property name=\"metric:u-max\" value=\"0.25\"/>"));
  EXPECT_FALSE(has(text, "metric:a-max")) << "not measured";
  EXPECT_FALSE(has(text, "name=\"v_error\"")) << "not measured";
  EXPECT_TRUE(has(text, "<property name=\"N\" value=\"2\"/>"));
}

TEST(CheckJunit, SkipsWhatIsUndecidedAndPassesTheRest) {
  EXPECT_TRUE(has(written(Format::junit, alone(Verdict::undecided)), "<skipped message="));
  for (const auto verdict : {Verdict::agrees, Verdict::not_claimed}) {
    const auto text = written(Format::junit, alone(verdict));
    EXPECT_TRUE(has(text, "failures=\"0\" errors=\"0\" skipped=\"0\"")) << text;
    EXPECT_TRUE(has(text, "<testcase name=\"fine.csv\""));
    EXPECT_FALSE(has(text, "<failure"));
  }
}

TEST(CheckLatex, HasARowAFileAndTheVerdictBelow) {
  const auto text = written(Format::latex);
  EXPECT_TRUE(has(text, "\\label{tab:clackers-check-three-parameter}"));
  EXPECT_TRUE(has(text,
                  "fine.csv} & $2001$ & $1.0\\cdot 10^{-2}$ & $1.0\\cdot 10^{-3}$ & -- & "
                  "$4/6$ & $1.2\\cdot 10^{-1}$ \\\\\n"))
      << text;
  EXPECT_TRUE(has(text, "\\par Together: undecided, order --.\n"));
  EXPECT_TRUE(has(text, "\\par Verdict: disagrees. It finds 4 of 6 collisions. [too-few-levels]"));
  EXPECT_FALSE(has(written(Format::latex, alone(Verdict::agrees)), "Together"));
}

TEST(CheckStudy, IsALadderOfTheFiles) {
  auto record = sample_check();
  record.files[0].score.u_error = std::nan("");
  const auto study = as_study(record);
  ASSERT_EQ(study.methods.size(), 1u);
  const auto& ladder = study.methods[0].ladder;
  ASSERT_EQ(ladder.size(), 2u);
  EXPECT_EQ(ladder[0].step, 0.02);
  EXPECT_TRUE(ladder[0].runs.empty()) << "nothing was measured";
  ASSERT_EQ(ladder[1].runs.size(), 1u);
  EXPECT_EQ(ladder[1].runs[0].u_error, 0.001);
  EXPECT_EQ(study.methods[0].assessment.verdict, Verdict::disagrees);
  EXPECT_EQ(study.methods[0].error_history.t.size(), 201u);
}

nlohmann::json block(const std::string& page, const std::string& id) {
  const auto open = page.find("id=\"" + id + "\">");
  const auto from = page.find('>', open) + 1;
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST(CheckHtml, TellsVerdictFilesNotesAndMetrics) {
  const auto page = check_html(sample_check());
  EXPECT_TRUE(has(page, "<span class=\"badge disagrees\">disagrees</span> <span>It finds 4 of 6"));
  EXPECT_TRUE(has(page, "fine.csv</th>"));
  EXPECT_TRUE(has(page, "<li>No events file")) << "a note of all files";
  EXPECT_TRUE(has(page, "<li>/a/long/way/to/coarse.csv: The first row"));
  EXPECT_TRUE(has(page, "The 2 histories together: <strong>undecided</strong> <span"));
  EXPECT_TRUE(has(page, "<code>u-max</code></th>"));
  EXPECT_TRUE(has(page, "max |u - u*| over the history&#39;s times"));
  EXPECT_TRUE(has(page, "<code>v-max</code> *</th>"));
  EXPECT_TRUE(has(page, "There are no accelerations. Not measured: <code>a-max</code>."));
  EXPECT_FALSE(has(page, "{{")) << "an empty slot";
}

TEST(CheckHtml, DrawsWhatThereIs) {
  const auto all = block(check_html(sample_check()), "specifications");
  EXPECT_TRUE(all.contains("response") && all.contains("history") && all.contains("convergence"));
  const auto one = block(check_html(alone(Verdict::agrees)), "specifications");
  EXPECT_TRUE(one.contains("history"));
  EXPECT_FALSE(one.contains("convergence")) << "one point is no line";
  auto partial = alone(Verdict::not_claimed);
  partial.files[0].history = partial.files[0].error_history = {};
  partial.files[0].metrics.clear();
  const auto page = check_html(partial);
  EXPECT_FALSE(block(page, "specifications").contains("history"));
  EXPECT_FALSE(has(page, "data-plot=\"history\""));
  EXPECT_TRUE(has(page, "Metrics need the displacements of all masses"));
}

TEST(CheckHtml, HasTheRowsOfTheFinestHistory) {
  const auto data = block(check_html(sample_check()), "data");
  ASSERT_EQ(data["history_rows"].size(), 2u);
  EXPECT_EQ(data["history_rows"][1]["series"], "mass 2");
  EXPECT_EQ(data["history_rows"][1]["t"].size(), 201u);
  EXPECT_EQ(data["runs"]["rows"].size(), 2u);
}

TEST(CheckHtml, EscapesNames) {
  auto record = sample_check();
  for (auto& file : record.files) file.file = "<script>alert(1)</script>.csv";
  record.files[1].notes = {"<b>"};
  const auto page = check_html(record);
  EXPECT_FALSE(has(page, "<script>alert"));
  EXPECT_FALSE(has(page, "<b>"));
}

}  // namespace
}  // namespace clackers::report
