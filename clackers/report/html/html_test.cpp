#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "clackers/base/files/json.hpp"
#include "clackers/report/testing/sample_record.hpp"
#include "clackers/report/testing/written.hpp"

namespace clackers::report {
namespace {

nlohmann::ordered_json block(const std::string& page, const std::string& id) {
  const auto open = page.find("id=\"" + id + "\">");
  const auto from = page.find('>', open) + 1;
  return parse_json(page.substr(from, page.find("</script>", from) - from));
}

TEST(Html, IsOneFileThatLoadsNothing) {
  const auto page = html(sample_record());
  EXPECT_LT(page.size(), 2000000u);
  for (const auto part : {"<script src", "<link rel=\"stylesheet\"", "@import", "url("})
    EXPECT_FALSE(has(page.substr(0, page.find("id=\"data\"")), part)) << part;
  EXPECT_FALSE(has(page, "sourceMappingURL"));
  EXPECT_EQ(page.find("{{"), page.find("{{", page.find("vega"))) << "no slot of ours is left";
}

TEST(Html, ThePolicyHasAHashForEveryScriptAndForbidsTheRest) {
  const auto page = html(sample_record());
  const auto from = page.find("Content-Security-Policy");
  const auto policy = page.substr(from, page.find('>', from) - from);
  EXPECT_TRUE(has(policy, "default-src 'none'"));
  EXPECT_FALSE(has(policy, "unsafe-eval"));
  EXPECT_FALSE(has(policy.substr(policy.find("script-src"), policy.find("style-src")),
                   "script-src 'unsafe"));
  EXPECT_EQ(occurrences(policy, "'sha256-"), occurrences(page, "<script>"));
}

TEST(Html, IdsAreDifferentAndEveryLinkHasOne) {
  for (const auto& record : {sample_record(), sample_check(), sample_of_all()}) {
    const auto page = html(record);
    const auto body =
        page.substr(page.find("<body>"), page.find("id=\"data\"") - page.find("<body>"));
    std::set<std::string> ids;
    const std::regex id(" id=\"([^\"]*)\""), link("href=\"#([^\"]*)\"");
    for (std::sregex_iterator at(body.begin(), body.end(), id), end; at != end; ++at)
      EXPECT_TRUE(ids.insert((*at)[1]).second) << (*at)[1];
    for (std::sregex_iterator at(body.begin(), body.end(), link), end; at != end; ++at)
      EXPECT_TRUE(ids.contains((*at)[1])) << (*at)[1];
  }
}

TEST(Html, FiguresAreCountedWithoutGaps) {
  auto record = sample_record();
  for (const auto& problem : {record, sample_check(), sample_of_all()}) {
    const auto page = html(problem);
    const auto figures = occurrences(page, "<figure ");
    for (std::size_t i = 1; i <= figures; ++i)
      EXPECT_EQ(occurrences(page, "\">Figure " + std::to_string(i) + ". "), 1u) << i;
    EXPECT_EQ(block(page, "specifications").size(), occurrences(page, "class=\"plot\" data-plot="));
  }
  for (auto& subject : record.cases[0].subjects)
    for (auto& level : subject.levels)
      for (auto& run : level.runs) run.score.work = {}, run.score.seconds = 0.0;
  EXPECT_TRUE(has(html(record), "Figure 5. Performance profile")) << "without a figure of work";
}

TEST(Html, EverySpecificationHasItsDataAndItsFrame) {
  const auto page = html(sample_of_all());
  const auto data = block(page, "data"), specifications = block(page, "specifications");
  EXPECT_TRUE(specifications.contains("convergence-1") && specifications.contains("response-2"));
  for (const auto& [name, specification] : specifications.items()) {
    EXPECT_EQ(occurrences(page, "data-plot=\"" + name + "\""), 1u);
    const auto text = json_text(specification);
    const std::regex named("\"data\":\\{\"name\":\"([^\"]+)\"\\}");
    for (std::sregex_iterator at(text.begin(), text.end(), named), end; at != end; ++at)
      EXPECT_TRUE(data.contains((*at)[1].str())) << name << (*at)[1];
  }
}

TEST(Html, EverySubjectHasASectionAndTheRecordItsProvenance) {
  const auto record = sample_record();
  const auto page = html(record);
  for (std::size_t i = 1; i <= record.cases[0].subjects.size(); ++i)
    EXPECT_EQ(occurrences(page, "id=\"method-" + std::to_string(i) + "\""), 1u);
  EXPECT_TRUE(has(page, "<span class=\"badge disagrees\">disagrees</span>"));
  EXPECT_TRUE(has(page, "<pre id=\"command\">clackers verify --report report.html</pre>"));
  for (const auto& text : {record.provenance.compiler, record.provenance.processor})
    EXPECT_TRUE(has(page, "<dd>" + text + "</dd>")) << text;
  EXPECT_TRUE(has(page, "University of Washington Interactive Data Lab"));
}

TEST(Html, AnInterruptedRecordIsMarked) {
  auto record = sample_record();
  EXPECT_EQ(occurrences(html(record), "<strong>Interrupted.</strong>"), 1u);
  record.interrupted = false;
  EXPECT_EQ(occurrences(html(record), "<strong>Interrupted.</strong>"), 0u);
}

TEST(Html, WhatIsConcludedWithoutTheExactSolutionIsBesideTheTruth) {
  auto record = sample_record();
  auto page = html(record);
  EXPECT_EQ(occurrences(page, "<h4>Without the exact solution</h4>"), 7u)
      << "a refused method has no runs";
  EXPECT_EQ(occurrences(page,
                        "away from the reference solution. <span class=\"code\">[wrong-limit]"
                        "</span></p>"),
            1u);
  EXPECT_TRUE(has(page, "at the end = 0.25, −0.125, within 1.5\u202f×\u202f10<sup>−7</sup>"));
  EXPECT_TRUE(has(page, ": the limit is not the reference solution"));
  auto& result = record.cases[0].subjects[0].self_convergence;
  result->extrapolation.bounded = false;
  result->extrapolation.reason = "differences-turn";
  EXPECT_TRUE(has(html(record), "<dd>no bound. The differences between runs"));
  result.reset();
  EXPECT_TRUE(has(html(record), "<p>Not assessed: the method claims no order"));
}

TEST(Html, EveryMethodThatRanHasItsMetrics) {
  auto record = sample_record();
  const auto page = html(record);
  EXPECT_EQ(occurrences(page, "<details class=\"metrics\">"), 7u);
  EXPECT_EQ(occurrences(page, "<code>v-max</code> *</th>"), 7u);
  EXPECT_EQ(occurrences(page,
                        "<p>There are no impacts. Not measured: <code>period-fit-relative</code>, "
                        "<code>impact-spacing-max-relative</code>.</p>"),
            7u);
}

TEST(Html, HistoriesHaveFilesNotesAndMetrics) {
  const auto page = html(sample_check());
  EXPECT_TRUE(has(page, "<span class=\"badge disagrees\">disagrees</span> <span>Another motion"));
  EXPECT_TRUE(has(page, "fine.csv</th>"));
  EXPECT_TRUE(has(page, "<li>coarse.csv: The first row"));
  EXPECT_TRUE(has(page, "<span class=\"wrong\">4/6</span>"));
  EXPECT_TRUE(has(page, "<code>u-max</code></th>"));
}

TEST(Html, CountersOfWorkAreOfferedAndTimesAreNoProfile) {
  const auto page = html(sample_record());
  for (const auto* field : {"steps", "force_evaluations", "event_searches", "seconds"})
    EXPECT_EQ(occurrences(page, "data-counter=\"" + std::string(field) + "\" data-of=\"work\""), 1u)
        << field;
  EXPECT_EQ(occurrences(page, "data-of=\"work\" aria-pressed=\"true\""), 1u);
  EXPECT_FALSE(has(page, "data-counter=\"newton_iterations\""));
  EXPECT_FALSE(has(page, "data-counter=\"seconds\" data-of=\"profile\""));
}

TEST(Html, WhatCannotBeDrawnIsSaid) {
  auto record = sample_record();
  EXPECT_FALSE(has(html(record), "Not drawn:"));
  auto& runs = record.cases[0].subjects[0].levels[0].runs;
  runs[0].score.finished = false;
  runs[1].score.u_error = 0.0;
  EXPECT_TRUE(
      has(html(record), "Not drawn: 1 run that failed. Not drawn: 1 run without any error."));
}

TEST(Html, NoTextOfTheRecordBecomesMarkup) {
  auto record = sample_of_all();
  const auto scripts = occurrences(html(record), "</script>");
  const std::string evil = "</script><script>alert(1)</script><b x='\">&";
  record.provenance = {evil, evil, evil, evil, evil, evil};
  for (auto& problem : record.cases) {
    problem.problem.name = problem.problem.summary = problem.problem.equations = evil;
    for (auto* list : {&problem.problem.parameters, &problem.problem.constants})
      for (auto& quantity : *list) quantity = {evil, 1.0, evil, evil};
    for (auto& subject : problem.subjects) {
      subject.name = subject.claim.reason = subject.assessment.reason = evil;
      subject.assessment.displacement.reason = evil;
      if (!subject.refusal.empty()) subject.refusal = subject.refusal_code = evil;
      if (subject.self_convergence) {
        subject.self_convergence->against_reference = {true, evil, 0.0};
        subject.self_convergence->extrapolation.reason = evil;
      }
      for (auto& level : subject.levels)
        for (auto& run : level.runs) {
          run.score.failure = run.score.failure_code = evil;
          for (auto& metric : run.metrics) metric = {evil, evil, 1.0, {}, evil, true};
          if (!run.file) continue;
          run.file->file = evil;
          run.file->notes.push_back(record::note("columns-not-used", {}, evil));
        }
    }
  }
  const auto page = html(record);
  EXPECT_FALSE(has(page, "<script>alert"));
  EXPECT_FALSE(has(page, "<b x="));
  EXPECT_EQ(occurrences(page, "</script>"), scripts);
  EXPECT_EQ(block(page, "data")["levels-1"][0]["method"], evil);
}

TEST(Html, CausesOfHistoriesStandAboveTheNumbersOnce) {
  auto record = sample_check();
  auto& subject = record.cases[0].subjects[0];
  subject.diagnoses = {{"restitution-differs", 0.97, "1", 0.9, {}, "", ""}};
  const auto page = html(record);
  const auto block = page.find("<ul class=\"remarks diagnoses\">");
  ASSERT_NE(block, std::string::npos);
  EXPECT_LT(block, page.find("id=\"verdicts\""));
  EXPECT_EQ(page.find("<ul class=\"remarks diagnoses\">", block + 1), std::string::npos);
  // With other cases each has its own in its section.
  record.cases.push_back(record.cases[0]);
  EXPECT_GT(html(record).find("<ul class=\"remarks diagnoses\">"),
            html(record).find("id=\"verdicts-1\""));
}

TEST(Html, ToleranceIsOnTheAxisOfALadderOfTolerances) {
  auto record = sample_check();
  EXPECT_TRUE(has(html(record), "step h [s]"));
  record.cases[0].subjects[0].refined_by = record::RefinementParameter::tolerance;
  EXPECT_FALSE(has(html(record), "step h"));
}

}  // namespace
}  // namespace clackers::report
