#include <gtest/gtest.h>

#include "clackers/study/verify.hpp"

namespace clackers::study {
namespace {

Record judged(std::initializer_list<Verdict> verdicts) {
  Record record;
  for (const auto verdict : verdicts) {
    MethodResult method;
    method.assessment.verdict = verdict;
    record.methods.push_back(method);
  }
  return record;
}

TEST(ExitCode, OfOneMethodIsItsVerdict) {
  EXPECT_EQ(exit_code(judged({Verdict::agrees})), 0);
  EXPECT_EQ(exit_code(judged({Verdict::not_claimed})), 0);
  EXPECT_EQ(exit_code(judged({Verdict::disagrees})), 1);
  EXPECT_EQ(exit_code(judged({Verdict::undecided})), 3);
}

TEST(ExitCode, OfSeveralIsOneThenThreeThenZero) {
  EXPECT_EQ(exit_code(judged({Verdict::agrees, Verdict::undecided, Verdict::disagrees})), 1);
  EXPECT_EQ(exit_code(judged({Verdict::undecided, Verdict::agrees})), 3);
  EXPECT_EQ(exit_code(judged({Verdict::agrees, Verdict::not_claimed})), 0);
}

TEST(ExitCode, DoesNotCountAMethodThatRefusedTheCase) {
  auto record = judged({Verdict::agrees, Verdict::undecided});
  record.methods[1].refusal = "cannot";
  EXPECT_EQ(exit_code(record), 0);
}

TEST(ExitCode, OfAnInterruptedRecordIs130) {
  auto record = judged({Verdict::disagrees});
  record.interrupted = true;
  EXPECT_EQ(exit_code(record), 130);
}

}  // namespace
}  // namespace clackers::study
