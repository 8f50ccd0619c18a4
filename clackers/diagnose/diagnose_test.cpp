#include "clackers/diagnose/diagnose.hpp"

#include <gtest/gtest.h>

#include "clackers/diagnose/testing/ladder_sets.hpp"

namespace clackers::diagnose::testing {
namespace {

TEST(Diagnose, TheSystemThatExplainsALimitReplacesIt) {
  const auto plan = ladder_plan(0);
  auto problem = plan.problem.problem;
  problem.contacts.front().restitution = 0.95;
  const auto all = diagnose(files_of(plan, "method=rk4", problem).question());
  EXPECT_EQ(codes(all), "restitution-differs");
}

TEST(Diagnose, ExchangedMassesSilenceWhatIsFittedToThem) {
  const auto plan = ladder_plan(0);
  Files files{plan.problem};
  for (const double step : plan.steps) {
    auto rows = history_of("method=rk4", plan.problem.problem, step);
    for (auto* values : {&rows.u, &rows.v})
      for (std::size_t i = 0; i < values->size(); i += 2) std::swap((*values)[i], (*values)[i + 1]);
    files.add(rows, step);
  }
  EXPECT_EQ(codes(diagnose(files.question())), "masses-exchanged");
}

TEST(Diagnose, CorrectSolversHaveNoCauseButTheirOwnErrors) {
  for (const auto* method : {"method=rk4", "method=newmark"}) {
    const auto all = diagnose(files_of(ladder_plan(3), method).question());
    for (const auto& one : all)
      EXPECT_TRUE(one.code == "period-error" || one.code == "numerical-damping") << codes(all);
  }
}

TEST(Diagnose, RowsInsideAContactCountMoreThanAFittedGap) {
  const Diagnosis gap{.code = "gap-differs", .confidence = 1.0};
  const Diagnosis compliant{.code = "contact-compliant", .confidence = 0.9};
  EXPECT_TRUE(brings_about(compliant, gap));
  EXPECT_FALSE(brings_about(gap, compliant));
}

TEST(Diagnose, TheRowOfACauseSaysWhetherItIsAnotherSystemOrNoise) {
  const auto found = [](const char* code, double confidence) {
    Diagnosis cause;
    cause.code = code;
    cause.confidence = confidence;
    return cause;
  };
  EXPECT_TRUE(is_noise(found("noise-floor", sure)));
  EXPECT_FALSE(is_noise(found("noise-floor", 0.89)));
  EXPECT_FALSE(is_noise(found("printed-digits", 1.0)));
  EXPECT_TRUE(is_other_system(found("gap-differs", sure)));
  EXPECT_FALSE(is_other_system(found("gap-differs", 0.89)));
  EXPECT_FALSE(is_other_system(found("noise-floor", 1.0)));
  EXPECT_FALSE(is_other_system(found("no-such-code", 1.0)));
}

TEST(Diagnose, CausesComeStrongestFirst) {
  const auto plan = ladder_plan(0);
  auto files = files_of(plan, "method=exact contact=end-of-step");
  files.ladder.front().runs.front().finished = false;
  files.ladder.front().runs.front().failure_code = "newton-failed";
  const auto all = diagnose(files.question());
  ASSERT_EQ(all.size(), 2u) << codes(all);
  EXPECT_EQ(codes(all), "impact-at-step-end unstable-coarse-steps");
  EXPECT_GT(all[0].confidence, all[1].confidence);
}

TEST(Diagnosis, AClockThatIsALittleFastHasNoOtherUnit) {
  const auto of = [](double value, const char* unit) {
    return sentence_of({.code = "time-unit", .value = value, .text = unit});
  };
  EXPECT_EQ(of(1000.0, "ms"), "Times are in ms, 1000 times seconds: convert them to seconds.");
  EXPECT_TRUE(of(1.0001, "").starts_with("Times run 0.01 % too fast: "));
  EXPECT_TRUE(of(0.999, "").starts_with("Times run 0.1 % too slow: "));
}

TEST(Diagnosis, TheWholeIsAHundredPerCent) {
  const auto text = sentence_of({.code = "commensurate-steps", .evidence = {{"share", 1.0}}});
  EXPECT_NE(text.find(", 100 % of all,"), std::string::npos) << text;
}

TEST(Diagnosis, LateStepsHideNoWrongLimitAndLateSecondsDo) {
  Diagnosis late, limit;
  late.code = "time-shifted";
  limit.code = "wrong-limit";
  late.confidence = limit.confidence = 0.95;
  late.unit = "steps";
  EXPECT_FALSE(brings_about(late, limit));
  late.unit = "s";
  EXPECT_TRUE(brings_about(late, limit));
}

}  // namespace
}  // namespace clackers::diagnose::testing
