#include <gtest/gtest.h>

#include "clackers/base/text.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/testing/sample_record.hpp"
#include "clackers/report/testing/written.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

using Presence = study::SubjectChange::Presence;

std::string text_of_all(const study::SubjectChange& change) {
  std::string text;
  for (const auto& sentence : change_texts(change)) text += (text.empty() ? "" : " ") + sentence;
  return text;
}

study::SubjectChange named(const std::string& name = "rk4") {
  study::SubjectChange change;
  change.case_name = "three-parameter";
  change.name = name;
  return change;
}

TEST(Changes, AreCounted) {
  study::BaselineComparison all;
  all.before.date = "2030-01-02T03:04:05Z";
  all.before.version = "9.8.7";
  all.subjects = {named()};
  EXPECT_EQ(change_summary(all),
            "Against the baseline of 2030-01-02T03:04:05Z (clackers 9.8.7): nothing changed in 1 "
            "method.");
  all.subjects = {named(), named(), named("histories")};
  all.subjects[1].presence = Presence::added;
  all.interrupted = true;
  EXPECT_TRUE(has(change_summary(all), ", interrupted): 1 of 3 subjects changed."));
}

TEST(Changes, ASubjectIsNewOrGone) {
  auto change = named();
  change.presence = Presence::added;
  EXPECT_EQ(text_of_all(change), "is new; the baseline does not have it.");
  change.presence = Presence::gone;
  EXPECT_EQ(text_of_all(change), "is gone; only the baseline has it.");
}

TEST(Changes, VerdictBehaviourAndClaimAreGiven) {
  auto change = named();
  study::Finding before, now;
  before.verdict = Verdict::agrees;
  before.behaviour = Behaviour::proper;
  before.claim = {Behaviour::proper, 4, ""};
  now = before;
  now.verdict = Verdict::disagrees;
  now.behaviour = Behaviour::reduced;
  change.finding = {before, now};
  EXPECT_EQ(text_of_all(change),
            "verdict disagrees, before agrees. behaviour reduced, before proper.");
  now = before;
  now.claim.order = 3;
  now.reason = "energy-growth";
  change.finding = {before, now};
  EXPECT_EQ(text_of_all(change),
            "behaviour proper [energy-growth], before proper. claims proper, order 3, before "
            "proper, order 4.");
  now = before;
  now.complete = false;
  change.finding = {before, now};
  EXPECT_EQ(text_of_all(change), "verdict interrupted, before agrees.");
  now = {};
  now.refused = true;
  now.reason = "linear-only";
  now.claim = before.claim;
  change.finding = {before, now};
  EXPECT_EQ(text_of_all(change),
            "verdict refused, before agrees. behaviour not run, before proper.");
  before = now;
  now.reason = "redundant-contacts";
  change.finding = {before, now};
  EXPECT_EQ(text_of_all(change), "refused as [redundant-contacts], before [linear-only].");
  now = {};
  now.claim = before.claim;
  change.finding = {before, now};
  EXPECT_EQ(text_of_all(change),
            "verdict undecided, before refused. behaviour undecided, before not run.");
}

TEST(Changes, NumbersHaveTheirStep) {
  auto change = named();
  judge::LadderFit before, now;
  before.has_line = now.has_line = true;
  before.order = 3.98;
  before.spread = 0.012;
  now.order = 2.004;
  now.spread = 0.034;
  change.order = {before, now};
  EXPECT_EQ(text_of_all(change), "order 2.00 ±0.03, before 3.98 ±0.01.");
  change.order.reset();
  change.error = {0.000390625, 1.2e-7, 5.04e-7};
  EXPECT_EQ(text_of_all(change),
            "error in u at h = 0.0003906 s grew by a factor 4.2: 5.04e-7, before 1.20e-7.");
  change.error = {0.05, 5.04e-7, 1.2e-7};
  EXPECT_EQ(text_of_all(change),
            "error in u at h = 0.05 s shrank by a factor 4.2: 1.20e-7, before 5.04e-7.");
  change.error = {0.05, 0.0, 1.2e-7};
  EXPECT_EQ(text_of_all(change), "error in u at h = 0.05 s: 1.20e-7, before 0.");
  change.error.reset();
  change.impacts = {0.01, {6, 0, 1}, {6, 2, 0}};
  EXPECT_EQ(text_of_all(change),
            "misses 2 of 6 impacts at h = 0.01 s, before none. finds no extra impact at h = "
            "0.01 s, before 1.");
  change.impacts.reset();
  change.finished = {0.01, true, false};
  EXPECT_EQ(text_of_all(change), "the run at h = 0.01 s fails, before it reached its end.");
  change.finished = {0.01, false, true};
  EXPECT_EQ(text_of_all(change), "the run at h = 0.01 s reaches its end, before it failed.");
  change.finished.reset();
  change.work = {0.01, 2000, 8000};
  EXPECT_EQ(text_of_all(change), "takes 8000 force evaluations at h = 0.01 s, before 2000.");
}

TEST(Changes, AreShownByTextPageAndJunit) {
  const auto before = sample_record();
  auto now = before;
  auto& subjects = now.cases[0].subjects;
  subjects[0].name = "<new>";
  subjects[1].assessment.verdict = Verdict::disagrees;
  subjects[2].levels.back().runs.back().score.impacts->missed = 2;
  const auto changes = study::compare(now, before);
  const auto text = written(now, Format::table, {}, &changes);
  for (const auto& line : lines_of(text)) EXPECT_LE(display_width(line), 80u) << line;
  EXPECT_TRUE(has(text, "\ncentral-difference: verdict disagrees, before agrees.\n")) << text;
  EXPECT_TRUE(has(text, "\nrk4: misses 2 of 6 impacts at h = "));
  EXPECT_TRUE(has(text, "\nnewmark: is gone; only the baseline has it.\n"));
  const auto page = html(now, &changes);
  EXPECT_TRUE(has(page, "<a href=\"#changes\">Changes</a>"));
  EXPECT_TRUE(has(page, "central-difference</dt><dd><ul><li>verdict disagrees, before agrees."));
  EXPECT_TRUE(has(page, "&lt;new&gt;</dt>"));
  EXPECT_FALSE(has(html(now), "id=\"changes\""));
  EXPECT_TRUE(has(written(now, Format::junit, {}, &changes), "<system-out>Against the baseline"));
  EXPECT_FALSE(has(written(now, Format::junit), "<system-out>"));
}

}  // namespace
}  // namespace clackers::report
