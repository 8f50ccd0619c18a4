#include "clackers/report/writers.hpp"

#include <gtest/gtest.h>

#include <string>

#include "clackers/report/testing/sample_record.hpp"
#include "clackers/report/testing/written.hpp"

namespace clackers::report {
namespace {

// The element of a test, or of the first suite's head.
std::string test_of(const record::Record& record, const std::string& name) {
  const auto text = written(record, Format::junit);
  const auto from = text.find("<testcase name=\"" + name + '"');
  EXPECT_NE(from, std::string::npos) << name;
  return text.substr(from, text.find("</testcase>", from) - from);
}

std::string attribute(const std::string& text, const std::string& element,
                      const std::string& name) {
  const auto from = text.find(name + "=\"", text.find('<' + element)) + name.size() + 2;
  return text.substr(from, text.find('"', from) - from);
}

std::string property(const std::string& test, const std::string& name) {
  const auto start = "<property name=\"" + name + "\" value=\"";
  const auto from = test.find(start);
  if (from == std::string::npos) return {};
  return test.substr(from + start.size(),
                     test.find('"', from + start.size()) - from - start.size());
}

TEST(Junit, TotalsAreThoseOfTheTests) {
  const auto record = sample_record();
  // One of eight disagrees, one was interrupted, one refused; of all suites and of the first.
  EXPECT_EQ(occurrences(written(record, Format::junit),
                        " tests=\"8\" failures=\"1\" errors=\"1\" skipped=\"1\" "),
            2u);
  EXPECT_TRUE(has(test_of(record, "generalized-alpha:rho=0.8"), "<failure "));
  EXPECT_TRUE(has(test_of(record, "newmark+penalty:stiffness=1e6"), "<skipped "));
  EXPECT_TRUE(has(test_of(record, "moreau-jean"), "<error "));
  EXPECT_FALSE(has(test_of(record, "newmark"), "<failure "));
}

TEST(Junit, AFailureHasItsCodeAndALineALevel) {
  auto record = sample_record();
  record.cases[0].subjects[3].levels[1].runs[2].score.finished = false;
  const auto test = test_of(record, "generalized-alpha:rho=0.8");
  EXPECT_EQ(attribute(test, "failure", "type"), "reduced");
  EXPECT_TRUE(has(attribute(test, "failure", "message"), "[reduced]"));
  EXPECT_EQ(occurrences(test, "\nh = "), 8u);
  EXPECT_TRUE(has(test, "6 of 6 impacts matched, 1 of 8 runs failed\n"));
}

TEST(Junit, AnUndecidedSubjectIsSkipped) {
  auto record = sample_record();
  record.cases[0].subjects[2].assessment.verdict = Verdict::undecided;
  EXPECT_TRUE(has(test_of(record, "rk4"), "<skipped "));
}

TEST(Junit, PropertiesReadBackToTheSameNumbers) {
  auto record = sample_record();
  auto& subject = record.cases[0].subjects[0];
  subject.levels.resize(1);
  subject.levels[0].runs.resize(2);
  subject.levels[0].runs[0].score.seconds = 1.25;
  subject.levels[0].runs[1].score.seconds = 0.5;
  subject.levels[0].runs[1].score.u_error = 0.30000000000000004;
  const auto test = test_of(record, "newmark");
  EXPECT_EQ(attribute(test, "testcase", "time"), "1.750");
  EXPECT_EQ(attribute(test, "testcase", "classname"), "clackers.verify.three-parameter");
  EXPECT_EQ(property(test, "u_error"), "0.30000000000000004");
  EXPECT_EQ(property(test, "order"), "2.0123");
  EXPECT_EQ(property(test, "impacts_matched"), "6");
  EXPECT_EQ(property(written(record, Format::junit), "N"), "2");
}

TEST(Junit, WhatWasNotMeasuredIsLeftOut) {
  auto record = sample_record();
  for (auto& run : record.cases[0].subjects[0].levels.back().runs) run.score.finished = false;
  const auto test = test_of(record, "newmark");
  EXPECT_EQ(property(test, "u_error"), "");
  EXPECT_FALSE(has(test, "\"nan")) << test;
}

TEST(Junit, HistoriesAreOneTestWithALineAFile) {
  const auto test = test_of(sample_check(), "histories");
  EXPECT_EQ(attribute(test, "testcase", "classname"), "clackers.check.three-parameter");
  EXPECT_EQ(property(test, "metric:u-max"), "1e-06");
  EXPECT_EQ(property(test, "metric:period-fit-relative"), "") << "not measured";
  EXPECT_TRUE(has(test, "fine.csv: h = 0.01 s: error in u 1.00e-3, 4 of 6 impacts matched\n"));
  EXPECT_TRUE(has(test, "No events file"));
}

TEST(Junit, EachCaseIsASuite) {
  EXPECT_EQ(occurrences(written(sample_of_all(), Format::junit), "<testsuite "), 2u);
}

TEST(Junit, NoTextBecomesMarkup) {
  auto record = sample_record();
  const std::string evil = "]]><b x='\">&\x01\xff\n";
  record.provenance = {evil, evil, evil, evil, evil, evil};
  record.cases[0].problem.name = evil;
  for (auto& subject : record.cases[0].subjects) subject.name = subject.assessment.reason = evil;
  record.cases[0].subjects.back().refusal = record.cases[0].subjects.back().refusal_code = evil;
  const auto text = written(record, Format::junit);
  for (const auto* markup : {"<b", "\x01", "&#1;", "&#01;", "\xff", "]]>"})
    EXPECT_FALSE(has(text, markup)) << markup;
  EXPECT_TRUE(
      has(text, "<testcase name=\"]]&gt;&lt;b x='&quot;&gt;&amp;\xEF\xBF\xBD\xEF\xBF\xBD&#10;\""));
}

TEST(Junit, ALadderOfTolerancesHasNoStep) {
  auto record = sample_record();
  EXPECT_FALSE(property(test_of(record, "newmark"), "step").empty());
  EXPECT_EQ(property(test_of(record, "newmark"), "solver_tolerance"), "");
  record.cases[0].subjects[0].refined_by = record::RefinementParameter::tolerance;
  const auto test = test_of(record, record.cases[0].subjects[0].name);
  EXPECT_EQ(property(test, "step"), "");
  EXPECT_FALSE(property(test, "solver_tolerance").empty());
}

}  // namespace
}  // namespace clackers::report
