#include "clackers/report/junit/junit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <pugixml.hpp>

#include "clackers/report/testing/sample_record.hpp"
#include "clackers/report/testing/written.hpp"

namespace clackers::report {
namespace {

pugi::xml_document parsed(const record::Record& record) {
  pugi::xml_document document;
  const auto text = written(record, Format::junit);
  EXPECT_TRUE(document.load_string(text.c_str())) << text;
  return document;
}

pugi::xml_node test_of(const pugi::xml_document& document, const char* name) {
  return document.child("testsuites")
      .child("testsuite")
      .find_child_by_attribute("testcase", "name", name);
}

std::string property(const pugi::xml_node& test, const char* name) {
  return test.child("properties")
      .find_child_by_attribute("property", "name", name)
      .attribute("value")
      .value();
}

TEST(Junit, TotalsAreThoseOfTheTests) {
  const auto document = parsed(sample_record());
  // One of eight disagrees, one was interrupted, one refused.
  for (const auto& node :
       {document.child("testsuites"), document.child("testsuites").child("testsuite")}) {
    EXPECT_EQ(node.attribute("tests").as_int(), 8);
    EXPECT_EQ(node.attribute("failures").as_int(), 1);
    EXPECT_EQ(node.attribute("errors").as_int(), 1);
    EXPECT_EQ(node.attribute("skipped").as_int(), 1);
  }
  EXPECT_TRUE(test_of(document, "generalized-alpha:rho=0.8").child("failure"));
  EXPECT_TRUE(test_of(document, "newmark+penalty:stiffness=1e6").child("skipped"));
  EXPECT_TRUE(test_of(document, "moreau-jean").child("error"));
  EXPECT_FALSE(test_of(document, "newmark").child("failure"));
}

TEST(Junit, AFailureHasItsCodeAndALineALevel) {
  auto record = sample_record();
  record.cases[0].subjects[3].levels[1].runs[2].score.finished = false;
  const auto document = parsed(record);
  const auto failure = test_of(document, "generalized-alpha:rho=0.8").child("failure");
  EXPECT_STREQ(failure.attribute("type").value(), "reduced");
  EXPECT_TRUE(has(failure.attribute("message").value(), "[reduced]"));
  EXPECT_EQ(occurrences(failure.text().get(), "\nh = "), 8u);
  EXPECT_TRUE(has(failure.text().get(), "6 of 6 impacts matched, 1 of 8 runs failed\n"));
}

TEST(Junit, AnUndecidedSubjectIsSkipped) {
  auto record = sample_record();
  record.cases[0].subjects[2].assessment.verdict = Verdict::undecided;
  EXPECT_TRUE(test_of(parsed(record), "rk4").child("skipped"));
}

TEST(Junit, PropertiesReadBackToTheSameNumbers) {
  auto record = sample_record();
  auto& subject = record.cases[0].subjects[0];
  subject.levels.resize(1);
  subject.levels[0].runs.resize(2);
  subject.levels[0].runs[0].score.seconds = 1.25;
  subject.levels[0].runs[1].score.seconds = 0.5;
  subject.levels[0].runs[1].score.u_error = 0.30000000000000004;
  const auto document = parsed(record);
  const auto test = test_of(document, "newmark");
  EXPECT_STREQ(test.attribute("time").value(), "1.750");
  EXPECT_STREQ(test.attribute("classname").value(), "clackers.verify.three-parameter");
  EXPECT_EQ(property(test, "u_error"), "0.30000000000000004");
  EXPECT_EQ(property(test, "order"), "2.0123");
  EXPECT_EQ(property(test, "impacts_matched"), "6");
  EXPECT_EQ(property(document.child("testsuites").child("testsuite"), "N"), "2");
}

TEST(Junit, WhatWasNotMeasuredIsLeftOut) {
  auto record = sample_record();
  for (auto& run : record.cases[0].subjects[0].levels.back().runs) run.score.finished = false;
  const auto document = parsed(record);
  const auto test = test_of(document, "newmark");
  EXPECT_EQ(property(test, "u_error"), "");
  for (const auto& each : test.child("properties"))
    EXPECT_FALSE(has(each.attribute("value").value(), "nan")) << each.attribute("name").value();
}

TEST(Junit, HistoriesAreOneTestWithALineAFile) {
  const auto document = parsed(sample_check());
  const auto test = test_of(document, "histories");
  EXPECT_STREQ(test.attribute("classname").value(), "clackers.check.three-parameter");
  EXPECT_EQ(property(test, "metric:u-max"), "1e-06");
  EXPECT_EQ(property(test, "metric:period-fit-relative"), "") << "not measured";
  const std::string log = test.child("failure").text().get();
  EXPECT_TRUE(has(log, "fine.csv: h = 0.01 s: error in u 1.00e-3, 4 of 6 impacts matched\n"));
  EXPECT_TRUE(has(log, "No events file"));
}

TEST(Junit, EachCaseIsASuite) {
  const auto document = parsed(sample_of_all());
  EXPECT_EQ(std::distance(document.child("testsuites").begin(), document.child("testsuites").end()),
            2);
}

TEST(Junit, NoTextBecomesMarkup) {
  auto record = sample_record();
  const std::string evil = "]]><b x='\">&\x01\xff\n";
  record.provenance = {evil, evil, evil, evil, evil, evil};
  record.cases[0].problem.name = evil;
  for (auto& subject : record.cases[0].subjects) subject.name = subject.assessment.reason = evil;
  record.cases[0].subjects.back().refusal = record.cases[0].subjects.back().refusal_code = evil;
  const auto text = written(record, Format::junit);
  EXPECT_FALSE(has(text, "<b"));
  EXPECT_FALSE(has(text, "\x01"));
  EXPECT_FALSE(has(text, "&#1;"));
  EXPECT_FALSE(has(text, "\xff"));
  const auto document = parsed(record);
  const std::string name =
      document.child("testsuites").child("testsuite").child("testcase").attribute("name").value();
  EXPECT_EQ(name, "]]><b x='\">&\xEF\xBF\xBD\xEF\xBF\xBD\n");
}

TEST(Junit, ALadderOfTolerancesHasNoStep) {
  auto record = sample_record();
  auto document = parsed(record);
  EXPECT_FALSE(property(test_of(document, "newmark"), "step").empty());
  EXPECT_EQ(property(test_of(document, "newmark"), "solver_tolerance"), "");
  record.cases[0].subjects[0].resolution = record::Resolution::tolerance;
  document = parsed(record);
  const auto test = test_of(document, record.cases[0].subjects[0].name.c_str());
  EXPECT_EQ(property(test, "step"), "");
  EXPECT_FALSE(property(test, "solver_tolerance").empty());
}

}  // namespace
}  // namespace clackers::report
