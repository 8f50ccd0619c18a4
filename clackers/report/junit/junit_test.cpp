#include "clackers/report/junit.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "clackers/report/sample_record.hpp"
#include "clackers/report/write.hpp"
#include "clackers/report/xml.hpp"

namespace clackers::report {
namespace {

std::string junit(const study::Record& record, const study::BaselineComparison* changes = nullptr) {
  std::ostringstream out;
  write(record, Format::junit, out, {}, changes);
  return out.str();
}

std::size_t occurrences(const std::string& text, std::string_view part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
    ++count;
  return count;
}

// The element of one method.
std::string test_of(const std::string& text, const std::string& method) {
  const auto from = text.find("<testcase name=\"" + method + "\"");
  return from == std::string::npos ? "" : text.substr(from, text.find("</testcase>", from) - from);
}

TEST(Xml, EscapesWhatXmlTakesForItsOwn) {
  EXPECT_EQ(xml_text("<a href=\"x\">'&'</a>]]>"),
            "&lt;a href=&quot;x&quot;&gt;&apos;&amp;&apos;&lt;/a&gt;]]&gt;");
  EXPECT_EQ(xml_text("one\ntwo\tthree\r\n"), "one\ntwo\tthree&#13;\n");
  EXPECT_EQ(xml_attribute("a", "one\ntwo\t\"x\""), " a=\"one&#10;two&#9;&quot;x&quot;\"");
}

TEST(Xml, PutsTheReplacementCharacterForWhatXmlCannotHold) {
  EXPECT_EQ(xml_text(std::string_view("a\0b\x1f", 4)),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD");
  EXPECT_EQ(xml_text("\xff"), "\xEF\xBF\xBD");
  EXPECT_EQ(xml_text("\xEF\xBF\xBE\xEF\xBF\xBF"), "\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(xml_text("xi₁ ±"), "xi₁ ±");
}

TEST(Junit, CountsWhatFailedWasSkippedAndWasInterrupted) {
  const auto text = junit(sample_record());
  // Seven of 8 levels and one that refused: one disagrees, one was interrupted, one refused. The
  // counts stand at the suite and at the whole.
  EXPECT_EQ(occurrences(text, " tests=\"8\" failures=\"1\" errors=\"1\" skipped=\"1\" time=\""), 2u)
      << text;
  EXPECT_EQ(occurrences(text, "<testcase "), 8u);
  EXPECT_EQ(occurrences(text, "<failure "), 1u);
  EXPECT_EQ(occurrences(text, "<skipped "), 1u);
  EXPECT_EQ(occurrences(text, "<error "), 1u);
}

TEST(Junit, FailsTheMethodThatDisagreesWithItsSentenceAndLevels) {
  const auto test = test_of(junit(sample_record()), "generalized-alpha:rho=0.8");
  EXPECT_NE(test.find("<failure message=\"reduced: the line is straight with slope 1.6, the method "
                      "claims order 2 [reduced]\" type=\"reduced\">claimed: proper, order 2\n"
                      "found: reduced\nh = 0.05 s: error in u "),
            std::string::npos)
      << test;
  EXPECT_EQ(occurrences(test, "\nh = "), 8u);
  EXPECT_NE(test.find(", 6 of 6 collisions\n"), std::string::npos);

  auto record = sample_record();
  record.methods[3].ladder[1].runs[2].finished = false;
  EXPECT_NE(junit(record).find(", 6 of 6 collisions, 1 of 8 runs failed\n"), std::string::npos);
}

TEST(Junit, SkipsRefusedAndUndecidedMethodsWithTheReason) {
  auto record = sample_record();
  record.methods[2].assessment.verdict = Verdict::undecided;
  record.methods[2].assessment.displacement.reason = "too-few-levels";
  const auto text = junit(record);
  EXPECT_NE(test_of(text, "newmark+penalty:stiffness=1e6")
                .find("<skipped message=\"newmark+penalty with eta = 0.5: a linear penalty spring "
                      "gives back what it takes, so it can only stand for eta = 1. "
                      "[penalty-needs-elastic]\"/>"),
            std::string::npos);
  EXPECT_NE(test_of(text, "rk4").find("[too-few-levels]\"/>"), std::string::npos);
  EXPECT_NE(text.find(" skipped=\"2\""), std::string::npos);
}

TEST(Junit, LetsAMethodPassThatAgreesOrClaimsNothing) {
  auto record = sample_record();
  record.methods[1].assessment.verdict = Verdict::not_claimed;
  const auto text = junit(record);
  for (const auto name : {"newmark", "central-difference"}) {
    const auto test = test_of(text, name);
    EXPECT_NE(test.find("<properties>"), std::string::npos);
    for (const auto part : {"<failure", "<skipped", "<error"})
      EXPECT_EQ(test.find(part), std::string::npos) << name;
  }
}

TEST(Junit, GivesProcessorTimeAndMeasuredNumbers) {
  auto record = sample_record();
  record.methods.resize(1);
  auto& ladder = record.methods[0].ladder;
  ladder.resize(1);
  ladder[0].runs.resize(2);
  ladder[0].runs[0].seconds = 1.25;
  ladder[0].runs[1].seconds = 0.5;
  ladder[0].runs[0].u_error = 0.1;
  ladder[0].runs[1].u_error = 0.30000000000000004;
  const auto text = junit(record);
  EXPECT_EQ(occurrences(text, " time=\"1.750\""), 3u) << text;
  for (const auto part :
       {"name=\"order\" value=\"2.0123\"", "name=\"order_spread\" value=\"0.012\"",
        "name=\"u_error\" value=\"0.30000000000000004\"", "name=\"seconds\" value=\"1.75\"",
        "name=\"behaviour\" value=\"proper\"", "name=\"collisions_found\" value=\"6\"",
        "name=\"N\" value=\"2\"", "name=\"command\" value=\"clackers verify --report report.html\"",
        "<testsuite name=\"three-parameter (N = 2, xi1 = 0.05, a_t = 1 m)\"",
        "classname=\"clackers.verify.three-parameter\"", "timestamp=\"2025-11-21T09:43:00Z\""})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(Junit, LetsNoTextBecomeMarkup) {
  auto record = sample_record();
  const std::string evil = "]]><b x='\">&\x01";
  record.provenance = {evil, evil, evil, evil, evil, evil};
  record.problem.name = evil;
  for (auto& method : record.methods) {
    method.name = method.assessment.sentence = evil;
    method.assessment.displacement.reason = method.claim.reason = evil;
  }
  record.methods.back().refusal = record.methods.back().refusal_code = evil;
  const auto text = junit(record);
  EXPECT_EQ(text.find("<b"), std::string::npos);
  EXPECT_EQ(text.find('\x01'), std::string::npos);
}

TEST(Junit, HoldsWhatChangedSinceABaselineAsItsOutput) {
  const auto record = sample_record();
  EXPECT_EQ(junit(record).find("<system-out>"), std::string::npos);
  const auto changes = study::compare(record, record);
  const auto text = junit(record, &changes);
  EXPECT_NE(text.find("<system-out>Against the baseline of 2025-11-21T09:43:00Z (clackers 0.1.0, "
                      "interrupted): nothing changed in"),
            std::string::npos);
  EXPECT_NE(text.find("methods.\n</system-out>"), std::string::npos);
}

}  // namespace
}  // namespace clackers::report
