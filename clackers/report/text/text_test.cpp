#include "clackers/report/writers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "clackers/base/text.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/testing/sample_record.hpp"
#include "clackers/report/testing/written.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

std::string text_of_record(const record::Record& record, const Style& style = {}) {
  return written(record, Format::table, style);
}

TEST(Text, NoLineIsLongerThanEightyColumnsOrEndsInASpace) {
  for (const auto& record : {sample_record(), sample_check(), sample_of_all()})
    for (const auto& line : lines_of(text_of_record(record))) {
      EXPECT_LE(display_width(line), 80u) << line;
      EXPECT_FALSE(line.ends_with(' ')) << line;
    }
}

TEST(Text, LongNamesAndThousandsOfImpactsStayWithinTheWidth) {
  auto record = sample_record();
  record.provenance.command = "clackers verify " + std::string(100, 'n');
  for (auto& subject : record.cases[0].subjects) {
    subject.name += "+event-driven:tolerance=1e-12,limit=100";
    for (auto& level : subject.levels)
      for (auto& run : level.runs)
        run.score.impacts = measure::ImpactScore{318309, 318310, 318309, 0, 1, 1e-12};
  }
  for (const int width : {40, 80, 120})
    for (const auto& line : lines_of(text_of_record(record, {.color = false, .width = width})))
      EXPECT_LE(display_width(line), std::size_t(width)) << line;
}

TEST(Text, ARowHasErrorOrderImpactsCostBehaviourAndVerdict) {
  // 0.8 h^2 at the finest level's largest step, 0.05/128 s: 1.2e-7; a third of it in the impact
  // times, three times it in energy; 20 s / h forces at the smallest step, 2^(7/8) times smaller.
  const auto text = text_of_record(sample_record());
  EXPECT_TRUE(has(text, " 1.2e-7 2.01±0.01  6/6  4.1e-8  3.7e-7 93901 proper     agrees")) << text;
}

// Twelve methods with two treatments, of which two disagree.
record::Record record_of_many() {
  auto record = sample_record();
  auto& subjects = record.cases[0].subjects;
  const auto sound = subjects[0];
  subjects.clear();
  for (const char* treatment : {"", "+penalty"})
    for (const char* name : {"explicit-generalized-alpha", "linear-acceleration", "newmark", "rk4",
                             "chang", "kr-alpha:rho=0.9"}) {
      subjects.push_back(sound);
      record::name_method(subjects.back(), std::string(name) + treatment);
    }
  for (const std::size_t i : {8u, 9u}) {
    subjects[i].assessment.verdict = Verdict::disagrees;
    subjects[i].assessment.reason = "contact-stiffness";
  }
  return record;
}

TEST(Text, ManyMethodsStandInALineEachBelowTheirTreatment) {
  const auto lines = lines_of(text_of_record(record_of_many()));
  const auto place = [&](const std::string& start) {
    return std::ranges::find_if(lines, [&](const auto& line) { return line.starts_with(start); }) -
           lines.begin();
  };
  EXPECT_EQ(place("newmark  ") - place("penalty, 6 methods"), 1);
  EXPECT_EQ(place("event-driven, 6 methods") - place("penalty, 6 methods"), 8);
  EXPECT_EQ(place("rk4  ") - place("newmark  "), 1);
  EXPECT_TRUE(has(lines.at(std::size_t(place("explicit-generalized-alpha"))), "agrees"));
  const auto is_against = [](const auto& line) { return line.ends_with(" disagrees"); };
  EXPECT_EQ(std::ranges::count_if(lines, is_against), 2);
  EXPECT_TRUE(has(text_of_record(record_of_many()), "newmark+penalty and 1 more with penalty: "));
  for (const auto& line : lines) EXPECT_LE(display_width(line), 80u) << line;
  EXPECT_FALSE(has(text_of_record(record_of_many()), "force"));
  EXPECT_TRUE(has(text_of_record(record_of_many(), {.width = 120}), "force"));
}

TEST(Text, OnlyVerdictsAskedForAreShownAndAllAreCounted) {
  const auto text = text_of_record(record_of_many(), {.only = {"disagrees"}});
  EXPECT_TRUE(has(text, "Only disagrees: 2 of 12 methods.")) << text;
  EXPECT_TRUE(has(text, "penalty, 2 methods\nnewmark"));
  EXPECT_FALSE(has(text, "event-driven"));
  EXPECT_TRUE(has(text, "\nInterrupted: of 12 methods, 10 agree, 2 disagree.")) << text;
  const auto none = text_of_record(record_of_many(), {.only = {"undecided", "not claimed"}});
  EXPECT_TRUE(has(none, "Only undecided or not claimed: 0 of 12 methods.")) << none;
}

TEST(Text, OfHistoriesTheCauseAndTheAnswerStandBeforeTheNumbers) {
  auto record = sample_check();
  auto& subject = record.cases[0].subjects[0];
  subject.diagnoses = {{"restitution-differs", 0.97, "1", 0.9, {}, "", ""}};
  auto text = text_of_record(record);
  const auto answer = finding(subject)->sentence.substr(0, 20);
  EXPECT_LT(text.find("[restitution-differs]"), text.find(answer));
  EXPECT_LT(text.find(answer), text.find("imp."));
  EXPECT_FALSE(has(text, "tolerance"));
  subject.refined_by = record::RefinementParameter::tolerance;
  text = text_of_record(record);
  EXPECT_TRUE(has(text, "tolerance"));
  EXPECT_FALSE(has(text, "h = "));
}

// No output says at its end, or as a cause, what its first line denies.
TEST(Text, OpensWithTheVerdictAndNeverContradictsIt) {
  auto agreed = sample_check();
  agreed.cases.front().subjects.front().assessment.verdict = Verdict::agrees;
  agreed.cases.front().subjects.front().diagnoses.clear();
  for (const auto& record : {sample_check(), sample_of_all(), record_of_many(), agreed}) {
    const auto lines = lines_of(text_of_record(record));
    const auto word = std::string(record::verdict_word(record));
    auto opening = word + ": ";
    opening.front() = char(std::toupper(opening.front()));
    const auto& first = lines[record.interrupted ? 1 : 0];
    EXPECT_TRUE(first.starts_with(opening)) << first;
    EXPECT_TRUE(lines.back().starts_with("Verdict: " + word)) << lines.back();
    for (const auto& cause : diagnose::causes()) {
      const bool denies = word == "agrees" && cause.effect == diagnose::CauseEffect::other_system;
      EXPECT_FALSE(denies &&
                   has(text_of_record(record), "[" + std::string(cause.code.name()) + "]"));
    }
  }
}

TEST(Text, SaysACauseOnceInTheFirstLine) {
  auto record = sample_check();
  auto& causes = record.cases.front().subjects.front().diagnoses;
  causes = {{"restitution-differs", 0.97, "1", 0.9, {}, "", ""}};
  const auto& cause = causes.front();
  const auto text = text_of_record(record);
  const auto mark = "[" + cause.code + "]";
  const auto first = text.find(mark);
  EXPECT_LT(first, text.find(record.cases.front().problem.name));
  EXPECT_EQ(text.find(mark, first + 1), std::string::npos) << text;
}

TEST(Text, AnInterruptedRecordIsMarked) {
  auto record = sample_record();
  EXPECT_TRUE(text_of_record(record).starts_with("INTERRUPTED"));
  EXPECT_EQ(lines_of(text_of_record(record)).back(),
            "Verdict: interrupted. Next: clackers verify --report report.html");
  record.interrupted = false;
  EXPECT_FALSE(has(text_of_record(record), "INTERRUPTED"));
}

TEST(Text, ACommandThatIsTooLongIsDescribed) {
  auto record = sample_check();
  record.interrupted = true;
  record.provenance.command = "clackers check " + std::string(80, 'n');
  EXPECT_EQ(lines_of(text_of_record(record)).back(),
            "Verdict: interrupted. Next: the same command again");
}

TEST(Text, SeveralCasesHaveATableEachAndOneVerdict) {
  auto record = sample_of_all();
  const auto text = text_of_record(record);
  EXPECT_TRUE(has(text, "three-parameter (N = 2"));
  EXPECT_TRUE(has(text, "\nstop (N = 2"));
  EXPECT_TRUE(has(text, "No performance profile"));
  EXPECT_EQ(occurrences(text, "Verdict: "), 1u);
  record.profiles = sample_record().cases[0].profiles;
  record.cases.back() = record.cases.front();
  EXPECT_TRUE(has(text_of_record(record), "Performance profile over 2 cases"));
}

TEST(Text, HistoriesHaveFilesNotesAndMetrics) {
  const auto text = text_of_record(sample_check());
  EXPECT_TRUE(has(text, "\nfine.csv ")) << text;
  EXPECT_FALSE(has(text, "/a/long/way"));
  EXPECT_TRUE(has(text, "No events file"));
  EXPECT_TRUE(has(text, "energy-max-relative *"));
  EXPECT_TRUE(has(text, "Not measured: period-fit-relative, impact-spacing-max-relative"));
  EXPECT_FALSE(has(text, "v-max *"));
  EXPECT_TRUE(has(text, "2 more: --metrics all."));
  const auto all = text_of_record(sample_check(), {.all_metrics = true});
  EXPECT_TRUE(has(all, "v-max *"));
  EXPECT_FALSE(has(all, "--metrics all"));
}

TEST(Text, ImpactsAreShownWhenAsked) {
  EXPECT_FALSE(has(text_of_record(sample_check()), "Impacts of the finest history"));
  const auto text = text_of_record(sample_check(), {.impacts = true});
  EXPECT_TRUE(has(text, "Impacts of the finest history, read from its rows")) << text;
  EXPECT_TRUE(has(text, "4.7124"));
  EXPECT_TRUE(has(text, "0.475"));
  auto without = sample_check();
  without.cases[0].subjects[0].impacts.clear();
  EXPECT_TRUE(has(text_of_record(without, {.impacts = true}), "The rows show no impact"));
}

TEST(Text, ColourIsPrintedOnlyWhenAsked) {
  EXPECT_FALSE(has(text_of_record(sample_record()), "\x1b"));
  const auto text = text_of_record(sample_record(), {.color = true});
  EXPECT_TRUE(has(text, "\x1b[32magrees\x1b[0m"));
  EXPECT_TRUE(has(text, "\x1b[31mdisagrees\x1b[0m"));
}

TEST(Text, NoControlCharacterOfOthersIsPrinted) {
  const std::string evil = "\x1b[31m\x07\r\x7f\xc2\x9b\xe2\x80\xae\xff";
  auto record = sample_of_all();
  record.provenance.command = record.provenance.version = evil;
  for (auto& problem : record.cases) {
    problem.problem.name = evil;
    for (auto& subject : problem.subjects) {
      subject.name = subject.claim.reason = subject.assessment.reason = evil;
      if (!subject.refusal.empty()) subject.refusal = subject.refusal_code = evil;
      for (auto& level : subject.levels)
        for (auto& run : level.runs) {
          run.score.failure = evil;
          if (!run.file) continue;
          run.file->file = evil;
          run.file->notes.push_back(record::note("columns-not-used", {}, evil));
        }
    }
  }
  const auto text = text_of_record(record);
  for (const char c : text) EXPECT_TRUE(c == '\n' || c < 0 || (c >= ' ' && c != '\x7f')) << int(c);
  for (const auto* part : {"\xc2\x9b", "\xe2\x80\xae", "\xff"}) EXPECT_FALSE(has(text, part));
  EXPECT_TRUE(has(text, "\\x1b[31m\\x07\\x0d\\x7f\\xc2\\x9b"));
}

}  // namespace
}  // namespace clackers::report
