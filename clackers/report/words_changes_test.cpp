#include "clackers/report/changes.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "clackers/report/format.hpp"
#include "clackers/report/sample_record.hpp"

namespace clackers::report {
namespace {

using Presence = study::MethodChange::Presence;

// All sentences of one change, joined by spaces.
std::string told(const study::MethodChange& change) {
  study::BaselineComparison all;
  all.methods = {change};
  std::string text;
  for (const auto& method : change_texts(all))
    for (const auto& sentence : method.sentences) text += (text.empty() ? "" : " ") + sentence;
  return text;
}

study::MethodChange named() {
  study::MethodChange change;
  change.name = "rk4+event-driven";
  return change;
}

TEST(Changes, OfNothingAreNotTold) {
  EXPECT_EQ(told(named()), "");
  study::BaselineComparison all;
  all.before.date = "2030-01-02T03:04:05Z";
  all.before.version = "9.8.7";
  all.methods = {named()};
  EXPECT_EQ(change_summary(all),
            "Against the baseline of 2030-01-02T03:04:05Z (clackers 9.8.7): nothing changed in 1 "
            "method.");
}

TEST(Changes, AreCounted) {
  study::BaselineComparison all;
  all.methods = {named(), named(), named()};
  all.methods[1].presence = Presence::added;
  all.interrupted = true;
  EXPECT_NE(change_summary(all).find(", interrupted): 1 of 3 methods changed."), std::string::npos);
}

TEST(Changes, NameMethodsThatAreNewOrGone) {
  auto change = named();
  change.presence = Presence::added;
  EXPECT_EQ(told(change), "is new; the baseline does not have it.");
  change.presence = Presence::gone;
  EXPECT_EQ(told(change), "is gone; only the baseline has it.");
}

TEST(Changes, TellVerdictBehaviourAndClaim) {
  auto change = named();
  study::Standing before, now;
  before.verdict = Verdict::agrees;
  before.behaviour = Behaviour::proper;
  before.claim = {Behaviour::proper, 4, ""};
  now = before;
  now.verdict = Verdict::disagrees;
  now.behaviour = Behaviour::reduced;
  change.standing = {before, now};
  EXPECT_EQ(told(change), "verdict disagrees, before agrees. behaviour reduced, before proper.");
  now = before;
  now.claim.order = 3;
  now.reason = "energy-growth";
  change.standing = {before, now};
  EXPECT_EQ(told(change),
            "behaviour proper [energy-growth], before proper. claims proper, order 3, before "
            "proper, order 4.");
  now = before;
  now.complete = false;
  change.standing = {before, now};
  EXPECT_EQ(told(change), "verdict interrupted, before agrees.");
  now = {};
  now.refused = true;
  now.reason = "linear-only";
  now.claim = before.claim;
  change.standing = {before, now};
  EXPECT_EQ(told(change), "verdict refused, before agrees. behaviour not run, before proper.");
  before = now;
  now.reason = "simultaneous-contacts";
  change.standing = {before, now};
  EXPECT_EQ(told(change), "refused as [simultaneous-contacts], before [linear-only].");
  now = {};
  now.claim = before.claim;
  change.standing = {before, now};
  EXPECT_EQ(told(change),
            "verdict undecided, before refused. behaviour undecided, before not run.");
}

TEST(Changes, TellNumbersWithTheirStep) {
  auto change = named();
  assess::LadderFit before, now;
  before.has_line = now.has_line = true;
  before.order = 3.98;
  before.spread = 0.012;
  now.order = 2.004;
  now.spread = 0.034;
  change.order = {before, now};
  EXPECT_EQ(told(change), "order 2.00 ±0.03, before 3.98 ±0.01.");
  change.order.reset();
  change.error = {0.000390625, 1.2e-7, 5.04e-7};
  EXPECT_EQ(told(change),
            "error in u at h = 0.0003906 s grew by a factor 4.2: 5.04e-7, before 1.20e-7.");
  change.error = {0.05, 5.04e-7, 1.2e-7};
  EXPECT_EQ(told(change),
            "error in u at h = 0.05 s shrank by a factor 4.2: 1.20e-7, before 5.04e-7.");
  change.error = {0.05, 0.0, 1.2e-7};
  EXPECT_EQ(told(change), "error in u at h = 0.05 s: 1.20e-7, before 0.");
  change.error.reset();
  change.collisions = {0.01, {6, 0, 1}, {6, 2, 0}};
  EXPECT_EQ(told(change),
            "misses 2 of 6 collisions at h = 0.01 s, before none. finds no extra collisions at h = "
            "0.01 s, before 1.");
  change.collisions.reset();
  change.finished = {0.01, true, false};
  EXPECT_EQ(told(change), "the run at h = 0.01 s fails, before it reached its end.");
  change.finished = {0.01, false, true};
  EXPECT_EQ(told(change), "the run at h = 0.01 s reaches its end, before it failed.");
  change.finished.reset();
  change.work = {0.01, 2000, 8000};
  EXPECT_EQ(told(change), "takes 8000 force evaluations at h = 0.01 s, before 2000.");
}

TEST(Changes, StandBetweenTheTableAndItsLastLineWithinEightyColumns) {
  const auto before = sample_record();
  auto now = before;
  now.methods[0].name = "fresh";
  now.methods[1].assessment.verdict = Verdict::disagrees;
  now.methods[2].ladder.back().runs.back().impacts->missed = 2;
  const auto changes = study::compare(now, before);
  std::ostringstream out;
  write(now, Format::table, out, {}, &changes);
  const auto text = out.str();
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    EXPECT_LE(display_width(line), 80u) << line;
    lines.push_back(line);
  }
  EXPECT_TRUE(lines.back().starts_with("Verdict: "));
  EXPECT_NE(text.find("): 4 of\n9 methods changed.\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\ncentral-difference: verdict disagrees, before agrees.\n"),
            std::string::npos);
  EXPECT_NE(text.find("\nrk4: misses 2 of 6 collisions at h = "), std::string::npos);
  EXPECT_NE(text.find("\nnewmark: is gone; only the baseline has it.\n"), std::string::npos);
}

TEST(Changes, AreASectionOfThePageWithLinksToMethods) {
  const auto before = sample_record();
  auto now = before;
  now.methods[1].assessment.verdict = Verdict::disagrees;
  now.methods[0].name = "<new>";
  const auto changes = study::compare(now, before);
  const auto page = html(now, &changes);
  EXPECT_NE(page.find("<a href=\"#changes\">Changes</a>"), std::string::npos);
  EXPECT_NE(page.find("<dt><a href=\"#method-2\">central-difference</a></dt><dd><ul><li>verdict "
                      "disagrees, before agrees.</li></ul></dd>"),
            std::string::npos);
  EXPECT_NE(page.find("<dt><a href=\"#method-1\">&lt;new&gt;</a></dt>"), std::string::npos);
  EXPECT_NE(page.find("<dt>newmark</dt><dd><ul><li>is gone"), std::string::npos);
  EXPECT_EQ(html(now).find("id=\"changes\""), std::string::npos);
}

}  // namespace
}  // namespace clackers::report
