#include "clackers/study/check.hpp"

#include <gtest/gtest.h>

#include "clackers/base/error.hpp"

namespace clackers::study {
namespace {

TEST(Check, HasAnExitCode) {
  CheckRecord record;
  const auto code = [&](Verdict verdict) {
    record.verdict = verdict;
    return exit_code(record);
  };
  EXPECT_EQ(code(Verdict::agrees), 0);
  EXPECT_EQ(code(Verdict::not_claimed), 0);
  EXPECT_EQ(code(Verdict::disagrees), 1);
  EXPECT_EQ(code(Verdict::undecided), 3);
}

TEST(CheckExpectation, IsABehaviourWithAnOrderWhereItNeedsOne) {
  EXPECT_EQ(claim_from("proper:2").behaviour, Behaviour::proper);
  EXPECT_EQ(claim_from("irregular:1.5").order, 1.5);
  EXPECT_EQ(claim_from("exact").behaviour, Behaviour::exact);
  for (const auto* text : {"proper", "proper:", "proper:x", "proper:2x", "exact:2", "undecided",
                           "proper:0", "proper:-1", "proper:nan", "nothing", ""})
    EXPECT_THROW(claim_from(text), InputError) << text;
}

}  // namespace
}  // namespace clackers::study
