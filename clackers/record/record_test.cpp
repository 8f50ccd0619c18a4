#include "clackers/record/record.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clackers::record {
namespace {

CaseRecord assessed(std::initializer_list<Verdict> verdicts) {
  CaseRecord record;
  for (const auto verdict : verdicts) {
    Subject subject;
    subject.assessment.verdict = verdict;
    record.subjects.push_back(subject);
  }
  return record;
}

int code_of(std::vector<CaseRecord> cases) {
  Record record;
  record.cases = std::move(cases);
  return exit_code(record);
}

TEST(ExitCode, OfOneSubjectIsItsVerdict) {
  EXPECT_EQ(code_of({assessed({Verdict::agrees})}), 0);
  EXPECT_EQ(code_of({assessed({Verdict::not_claimed})}), 0);
  EXPECT_EQ(code_of({assessed({Verdict::disagrees})}), 1);
  EXPECT_EQ(code_of({assessed({Verdict::undecided})}), 3);
}

TEST(ExitCode, OfSeveralSubjectsAndCasesIsOneThenThreeThenZero) {
  EXPECT_EQ(code_of({assessed({Verdict::agrees, Verdict::undecided, Verdict::disagrees})}), 1);
  EXPECT_EQ(code_of({assessed({Verdict::undecided, Verdict::agrees})}), 3);
  EXPECT_EQ(code_of({assessed({Verdict::agrees, Verdict::not_claimed})}), 0);
  EXPECT_EQ(code_of({assessed({Verdict::undecided}), assessed({Verdict::disagrees})}), 1);
  EXPECT_EQ(code_of({assessed({Verdict::agrees}), assessed({Verdict::undecided})}), 3);
}

TEST(ExitCode, DoesNotCountAMethodThatRefusedTheCase) {
  auto record = assessed({Verdict::agrees, Verdict::undecided});
  record.subjects[1].refusal = "cannot";
  EXPECT_EQ(code_of({record}), 0);
}

TEST(ExitCode, OfAnInterruptedRecordIs130) {
  Record record;
  record.cases = {assessed({Verdict::disagrees})};
  record.interrupted = true;
  EXPECT_EQ(exit_code(record), 130);
}

TEST(Counts, HoldEverySubjectOnceUnderItsWord) {
  auto one = assessed({Verdict::agrees, Verdict::agrees, Verdict::disagrees, Verdict::undecided,
                       Verdict::not_claimed, Verdict::undecided, Verdict::agrees});
  one.subjects[5].refusal = "cannot";
  one.subjects[6].complete = false;
  Record record;
  record.cases = {one, assessed({Verdict::agrees})};
  const auto all = counts(record);
  EXPECT_EQ(all.agrees, 3);
  EXPECT_EQ(all.disagrees, 1);
  EXPECT_EQ(all.undecided, 1);
  EXPECT_EQ(all.not_claimed, 1);
  EXPECT_EQ(all.refused, 1);
  EXPECT_EQ(all.interrupted, 1);
  EXPECT_EQ(all.total(), 8);
  EXPECT_EQ(verdict_word(one.subjects[5]), "refused");
  EXPECT_EQ(verdict_word(one.subjects[6]), "interrupted");
  EXPECT_EQ(verdict_word(one.subjects[4]), "not claimed");
}

Run run(double u_error, bool finished = true) {
  Run one;
  one.score.finished = finished;
  one.score.u_error = u_error;
  one.score.work.steps = std::llround(1e3 * u_error);
  return one;
}

TEST(LevelScore, IsTheWorstOfTheRunsThatFinished) {
  const auto score = worst(Level{0.1, {run(0.2), run(9.0, false), run(0.3)}});
  EXPECT_EQ(score.step, 0.1);
  EXPECT_EQ(score.worst.u_error, 0.3);
  EXPECT_EQ(score.worst.work.steps, 300);
  EXPECT_EQ(score.runs, 3);
  EXPECT_EQ(score.failed, 1);
  EXPECT_TRUE(std::isnan(worst(Level{0.1, {run(9.0, false)}}).worst.u_error));
}

TEST(LevelScore, OfTheFinestIsThatOfTheLastLevelWithRuns) {
  Subject subject;
  EXPECT_TRUE(std::isnan(worst_of_finest(subject).step));
  EXPECT_EQ(worst_of_finest(subject).runs, 0);
  subject.levels = {{0.2, {run(0.4)}}, {0.1, {run(0.2)}}, {0.05, {}}};
  EXPECT_EQ(worst_of_finest(subject).step, 0.1);
  EXPECT_EQ(worst_of_finest(subject).worst.u_error, 0.2);
}

TEST(Subject, ShowsTheFinestRunWithMetricsOrHistory) {
  Subject subject;
  EXPECT_EQ(subject.shown_run(), nullptr);
  subject.levels = {{0.2, {run(0.4), run(0.3)}}, {0.1, {run(0.2)}}};
  EXPECT_EQ(subject.shown_run(), nullptr);
  subject.levels[0].runs[0].metrics = {{}};
  EXPECT_EQ(subject.shown_run(), &subject.levels[0].runs[0]);
  subject.levels[0].runs[1].error_history.t = {0.0};
  EXPECT_EQ(subject.shown_run(), &subject.levels[0].runs[1]);
}

Record with_runs(SubjectKind kind, const std::vector<bool>& finished) {
  Subject subject;
  subject.kind = kind;
  subject.levels.emplace_back();
  for (const bool good : finished) {
    auto& added = subject.levels[0].runs.emplace_back();
    added.score.step = double(subject.levels[0].runs.size());
    added.score.finished = good;
  }
  Record whole;
  whole.cases.emplace_back();
  whole.cases[0].subjects.push_back(subject);
  return whole;
}

TEST(FailedSolvers, AreThoseWithoutAFinishedRunWhateverOthersDo) {
  auto failed = with_runs(SubjectKind::program, {false, false});
  failed.cases[0].subjects.insert(failed.cases[0].subjects.begin(),
                                  with_runs(SubjectKind::method, {true}).cases[0].subjects.front());
  ASSERT_EQ(failed_solvers(failed).size(), 1u);
  EXPECT_EQ(failed_solvers(failed)[0].subject, &failed.cases[0].subjects[1]);
  EXPECT_EQ(failed_solvers(failed)[0].first->score.step, 1.0);
  EXPECT_EQ(exit_code(failed), 4);
  EXPECT_TRUE(failed_solvers(with_runs(SubjectKind::program, {false, true})).empty());
  EXPECT_TRUE(failed_solvers(with_runs(SubjectKind::method, {false})).empty());
  EXPECT_TRUE(failed_solvers(with_runs(SubjectKind::program, {})).empty());
  EXPECT_TRUE(failed_solvers(Record{}).empty());
}

}  // namespace
}  // namespace clackers::record
