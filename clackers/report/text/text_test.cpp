#include "clackers/report/verdict_table.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "clackers/report/digest.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/sample_record.hpp"

namespace clackers::report {
namespace {

std::string table(const study::Record& record, const Style& style = {}) {
  std::ostringstream out;
  write(record, Format::table, out, style);
  return out.str();
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

// The methods of the sample that ran to their end and agree.
study::Record only_agreeing() {
  auto record = sample_record();
  record.interrupted = false;
  std::erase_if(record.methods, [](const study::MethodResult& method) {
    return !method.refusal.empty() || method.assessment.verdict != Verdict::agrees;
  });
  return record;
}

TEST(VerdictTable, FitsIntoEightyColumns) {
  for (const auto& line : lines(table(sample_record()))) {
    EXPECT_LE(display_width(line), 80u) << line;
    EXPECT_FALSE(line.ends_with(' ')) << line;
  }
}

TEST(VerdictTable, SaysWhereSelfConvergenceWouldHaveLied) {
  auto record = sample_record();
  const auto text = table(record);
  EXPECT_NE(
      text.find("\n\nnewmark+penalty: Self-convergence would have lied: the runs converge to a"
                " limit\n0.0031 away from the true motion. [wrong-limit]\n"),
      std::string::npos)
      << text;
  auto& both = record.methods[5].self_convergence->against_reference;
  both.reason.clear();
  EXPECT_NE(table(record).find("0.0031 away from the true motion.\n"), std::string::npos);
  both.sentence = "Told in another way.";
  EXPECT_NE(table(record).find("newmark+penalty: Told in another way.\n"), std::string::npos);
  both.would_have_lied = false;
  EXPECT_EQ(table(record).find("would have lied"), std::string::npos);
}

TEST(VerdictTable, StaysWithinEightyColumnsWithThousandsOfCollisionsAndLongNames) {
  auto record = sample_record();
  record.provenance.command = "clackers verify " + std::string(100, 'n');
  for (auto& method : record.methods) {
    method.name += "+event-driven:tolerance=1e-12,limit=100";
    for (auto& level : method.ladder)
      for (auto& run : level.runs)
        run.impacts = assess::ImpactScore{318309, 318310, 318309, 0, 1, 1e-12};
  }
  for (const auto& line : lines(table(record))) EXPECT_LE(display_width(line), 80u) << line;
}

TEST(VerdictTable, ShowsOfAMethodErrorOrderCollisionsCostBehaviourAndVerdict) {
  // 0.8 h^2 at the finest level's largest step, 0.05/128 s: 1.2e-7; a third of it in the collision
  // times, three times it in energy; 20 s / h forces at the smallest neighbour, 2^(7/8) times
  // smaller.
  EXPECT_NE(
      table(sample_record())
          .find("newmark        1.2e-7 2.01±0.01   6/6  4.1e-8  3.7e-7 93901 proper     agrees\n"),
      std::string::npos)
      << table(sample_record());
}

TEST(VerdictTable, NamesMethodsAsTheyAreTyped) {
  auto record = sample_record();
  const auto plain = table(record);
  record.methods[0].name = "newmark+event-driven";
  EXPECT_EQ(table(record), plain);
}

TEST(VerdictTable, SaysStepsPerFastPeriodAndTheCase) {
  const auto text = table(sample_record());
  EXPECT_NE(text.find("three-parameter (N = 2, xi1 = 0.05, a_t = 1 m)"), std::string::npos);
  // 1.2582 s / 0.05 s and 128 times that.
  EXPECT_NE(text.find("25.16 to 3221 steps per fast"), std::string::npos);
  EXPECT_NE(text.find("20 s with 6 collisions"), std::string::npos);
}

TEST(VerdictTable, GivesASentenceWithItsCodeToMethodsThatNeedOneAndToNoOther) {
  auto text = table(sample_record(), {.color = false, .width = 400});
  EXPECT_NE(
      text.find("\nnewmark+penalty: stagnating at 3.1e-3 as claimed: each contact lasts 0.0157 s "
                "instead of an instant [contact-stiffness]\n"),
      std::string::npos);
  EXPECT_NE(text.find("\nnewmark+reversal: irregular as claimed"), std::string::npos);
  EXPECT_NE(text.find("claims order 2 [reduced]\n"), std::string::npos);
  EXPECT_NE(text.find("so it can only stand for eta = 1. [penalty-needs-elastic]\n"),
            std::string::npos);
  EXPECT_EQ(text.find("\nrk4:"), std::string::npos);
}

TEST(VerdictTable, MarksAnInterruptedRecord) {
  const auto text = table(sample_record());
  EXPECT_NE(text.find("INTERRUPTED"), std::string::npos);
  EXPECT_NE(text.find("[interrupted]"), std::string::npos);
  EXPECT_EQ(lines(text).back(), "Verdict: interrupted. Next: clackers verify --report report.html");
  EXPECT_EQ(table(only_agreeing()).find("INTERRUPTED"), std::string::npos);
}

TEST(VerdictTable, EndsWithTheVerdictAndTheNextCommand) {
  auto record = only_agreeing();
  record.provenance.command = "clackers verify";
  EXPECT_EQ(lines(table(record)).back(),
            "Verdict: agrees. Next: clackers verify --report report.html");
  record.provenance.command = "clackers verify --report x.html";
  EXPECT_EQ(lines(table(record)).back(), "Verdict: agrees. Next: clackers explain irregular");
  record.provenance.command = "clackers verify " + std::string(80, 'n');
  EXPECT_EQ(lines(table(record)).back(),
            "Verdict: agrees. Next: the same with --report report.html");

  record = sample_record();
  record.interrupted = false;
  EXPECT_EQ(lines(table(record)).back(), "Verdict: disagrees. Next: clackers explain reduced");
}

TEST(VerdictTable, NamesAnUndecidedMethodsReason) {
  auto record = only_agreeing();
  record.methods[0].assessment.verdict = Verdict::undecided;
  record.methods[0].assessment.displacement.behaviour = Behaviour::undecided;
  record.methods[0].assessment.displacement.reason = "too-few-levels";
  EXPECT_EQ(lines(table(record)).back(),
            "Verdict: undecided. Next: clackers explain too-few-levels");
}

TEST(VerdictTable, HasColourOnlyWhenAsked) {
  EXPECT_EQ(table(sample_record()).find('\x1b'), std::string::npos);
  const auto text = table(sample_record(), {.color = true});
  EXPECT_NE(text.find("\x1b[32magrees\x1b[0m"), std::string::npos);
  EXPECT_NE(text.find("\x1b[31mdisagrees\x1b[0m"), std::string::npos);
}

TEST(Digest, IsTheWorstOfTheFinestLevelThatRan) {
  auto method = sample_record().methods[4];
  auto& runs = method.ladder.back().runs;
  runs[3].u_error = 0.7;
  runs[2].impacts = assess::ImpactScore{6, 8, 5, 1, 3, 0.25};
  runs[5].impacts->worst_time_error = 0.5;
  runs[6].finished = false;
  runs[6].u_error = 99.0;
  runs[1].work.force_evaluations = 123456789;
  runs[0].seconds = 0.75;
  const auto d = digest(method);
  EXPECT_EQ(d.step, 0.05 / 128);
  EXPECT_EQ(d.u_error, 0.7);
  EXPECT_EQ(d.impacts->found, 8);
  EXPECT_EQ(d.impacts->worst_time_error, 0.5);
  EXPECT_EQ(d.force_evaluations, 123456789);
  EXPECT_EQ(d.seconds, 0.75);
  EXPECT_EQ(d.failed_runs, 1);
  EXPECT_EQ(d.runs, 64);

  method.ladder.push_back({1e-6, {}});  // interrupted before its first run
  EXPECT_EQ(digest(method).step, 0.05 / 128);
}

TEST(Digest, IsNotANumberWhereNothingRan) {
  const auto d = digest(sample_record().methods.back());
  EXPECT_TRUE(std::isnan(d.u_error) && std::isnan(d.energy_error) && std::isnan(d.v_error));
  EXPECT_FALSE(d.impacts.has_value());
}

TEST(Digest, WordsOfVerdictsAndClaims) {
  auto record = sample_record();
  EXPECT_EQ(verdict_word(record.methods[0]), "agrees");
  EXPECT_EQ(verdict_word(record.methods[6]), "interrupted");
  EXPECT_EQ(verdict_word(record.methods[7]), "refused");
  EXPECT_EQ(claim_text(record.methods[0].claim), "proper, order 2");
  EXPECT_EQ(claim_text(record.methods[5].claim), "stagnating [contact-stiffness]");
  EXPECT_EQ(claim_text(record.methods[5].claim, false), "stagnating");
  EXPECT_EQ(claim_text({}), "nothing");
  EXPECT_EQ(closing(record).sentence, "5 agree, 1 disagrees, 1 refused, 1 interrupted");
  assess::LadderFit fit;
  EXPECT_EQ(order_text(fit), "");
  fit.has_line = true;
  fit.order = 1.996;
  fit.spread = 12.3;
  EXPECT_EQ(order_text(fit), "2.00 ±12");
}

TEST(VerdictTable, CountsOneMethodAsOne) {
  auto record = sample_record();
  EXPECT_EQ(counted_methods(record), std::to_string(record.methods.size()) + " methods");
  record.methods.resize(1);
  EXPECT_EQ(counted_methods(record), "1 method");
}

}  // namespace
}  // namespace clackers::report
