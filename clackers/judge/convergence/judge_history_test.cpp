#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clackers/judge/convergence/judge.hpp"

// Verdicts on histories: printed digits, tolerance, and other motions.
namespace clackers::judge {
namespace {

measure::RunScore run(double step, double error, double printed = 0.0) {
  measure::RunScore score;
  score.step = step;
  score.finished = true;
  score.u_error = score.v_error = error;
  score.rounding_floor = std::max(printed, 2e-16 * 20.0 / step);
  score.impacts = measure::ImpactScore{6, 6, 6, 0, 0, error, 0.0};
  return score;
}

measure::Ladder levels(double order, double floor = 0.0, double printed = 0.0) {
  measure::Ladder ladder;
  for (int i = 0; i < 7; ++i) {
    const double h = 0.04 * std::exp2(-i);
    ladder.push_back({h, {run(h, std::pow(h, order) + floor, printed)}});
  }
  return ladder;
}

measure::Ladder one(const measure::RunScore& score) { return {{score.step, {score}}}; }

Assessment assessed(const measure::Ladder& ladder, const Claim& claim = {},
                    std::optional<double> tolerance = {}, HistoryFacts finest = {}) {
  finest.rows = std::llround(20.0 / ladder.back().step);
  return judge(ladder, claim, {.tolerance = tolerance, .finest = finest});
}

const Claim proper_2{Behaviour::proper, 2.0, {}}, exact{Behaviour::exact, 0.0, {}},
    any_floor{Behaviour::stagnating, 0.0, {}};

TEST(JudgeHistories, AnEarlyEndDecidesNothing) {
  const auto until = [](double last, long long impacts) {
    const HistoryFacts finest{
        .last = last, .end = 20.0, .expected_to_last = impacts, .expected = 6};
    return assessed(levels(2.0), proper_2, {}, finest);
  };
  EXPECT_EQ(until(18.0, 5).verdict, Verdict::agrees);
  EXPECT_EQ(until(17.9, 5).verdict, Verdict::undecided);
  EXPECT_EQ(until(17.9, 5).reason, "ends-early");
  EXPECT_EQ(until(19.0, 0).verdict, Verdict::undecided);
}

TEST(JudgeHistories, GoByTheExpectation) {
  EXPECT_EQ(assessed(levels(2.0), proper_2).verdict, Verdict::agrees);
  EXPECT_EQ(assessed(levels(1.0), proper_2).verdict, Verdict::disagrees);
  EXPECT_EQ(assessed(levels(1.0), {Behaviour::reduced, 1.0, {}}).verdict, Verdict::agrees);
  EXPECT_EQ(assessed(one(run(0.01, 1e-4)), proper_2).verdict, Verdict::undecided);
  EXPECT_EQ(assessed(levels(2.0)).verdict, Verdict::not_claimed);
  EXPECT_TRUE(assessed(one(run(0.01, 1e-4))).reason.empty());
}

TEST(JudgeHistories, ThatConvergeToAnotherMotionDisagreeUnlessAFloorIsExpected) {
  const auto verdict = [](const Claim& claim) {
    return judge(levels(2.0), claim, {.finest = HistoryFacts{}, .wrong_limit = true}).verdict;
  };
  EXPECT_EQ(verdict({}), Verdict::disagrees);
  EXPECT_EQ(verdict(proper_2), Verdict::disagrees);
  EXPECT_EQ(verdict(any_floor), judge(levels(2.0), any_floor, {.finest = HistoryFacts{}}).verdict);
  EXPECT_EQ(judge(levels(2.0), {}, {.finest = HistoryFacts{}}).verdict, Verdict::not_claimed);
}

TEST(JudgeHistories, PrintedDigitsThatStopTheLevelsAreNamed) {
  // Errors of order 2 and of printing, which adds up to its floor.
  const HistoryFacts printed{.printed_floor = 5e-5};
  for (const auto& claim : {Claim{}, proper_2}) {
    const auto found = assessed(levels(2.0, 5e-5, 5e-5), claim, {}, printed);
    EXPECT_EQ(found.displacement.behaviour, Behaviour::stagnating);
    EXPECT_EQ(found.reason, "printed-digits");
    EXPECT_EQ(found.verdict, claim.order > 0.0 ? Verdict::undecided : Verdict::not_claimed);
    ASSERT_FALSE(found.evidence.empty());
    EXPECT_EQ(found.evidence[0].code, "printed-digits");
    EXPECT_EQ(found.evidence[0].numbers[1], 5e-5);
  }
  EXPECT_EQ(assessed(levels(2.0, 5e-5, 5e-5), any_floor, {}, printed).verdict, Verdict::agrees);
  // The same floor with all digits is not printing's.
  EXPECT_NE(assessed(levels(2.0, 5e-3)).reason, "printed-digits");
  // A line that is long enough above the floor stays a line.
  const HistoryFacts fine{.printed_floor = 1e-9};
  EXPECT_EQ(assessed(levels(2.0, 1e-9, 1e-9), proper_2, {}, fine).verdict, Verdict::agrees);
}

TEST(JudgeHistories, PrintedDigitsThroughoutAreNotExact) {
  const auto found =
      assessed(one(run(0.01, 4e-6, 5e-6)), exact, {}, HistoryFacts{.printed_floor = 5e-6});
  EXPECT_EQ(found.verdict, Verdict::undecided);
  EXPECT_EQ(found.reason, "printed-digits");
  EXPECT_EQ(assessed(one(run(0.01, 1e-13)), exact).verdict, Verdict::agrees);
}

TEST(JudgeHistories, GoByTheToleranceOfTheFinestUnlessPrintingHidesIt) {
  const measure::Ladder two{{0.02, {run(0.02, 1e-1)}}, {0.01, {run(0.01, 1e-3)}}};
  EXPECT_EQ(assessed(two, {}, 2e-3).verdict, Verdict::agrees);
  EXPECT_EQ(assessed(one(run(0.01, 3e-3)), {}, 2e-3).verdict, Verdict::disagrees);
  EXPECT_EQ(assessed(one(run(0.01, 2e-3)), {}, 2e-3).verdict, Verdict::undecided)
      << "rounded numbers do not decide equality";
  const HistoryFacts coarse{.printed_floor = 5e-4};
  for (const double error : {1.8e-3, 2.2e-3})
    EXPECT_EQ(assessed(one(run(0.01, error)), {}, 2e-3, coarse).reason, "printed-digits");
  EXPECT_EQ(assessed(one(run(0.01, 1e-3)), {}, 2e-3, coarse).verdict, Verdict::agrees);
}

TEST(JudgeHistories, VerdictIsTheWorseOfExpectationAndTolerance) {
  EXPECT_EQ(assessed(levels(2.0), proper_2, 1e-9).verdict, Verdict::disagrees);
  EXPECT_EQ(assessed(levels(1.0), proper_2, 1.0).verdict, Verdict::disagrees);
  EXPECT_EQ(assessed(one(run(0.01, 1e-4)), proper_2, 1.0).verdict, Verdict::undecided);
  EXPECT_EQ(assessed(levels(2.0), proper_2, 1.0).verdict, Verdict::agrees);
}

TEST(JudgeHistories, AnotherMotionDisagreesThoughNothingIsClaimed) {
  auto missed = run(0.01, 0.3), extra = missed;
  missed.impacts->missed = 1;
  extra.impacts->extra = 1;
  for (const auto& wrong : {missed, extra}) {
    EXPECT_EQ(assessed(one(wrong)).verdict, Verdict::disagrees);
    EXPECT_EQ(assessed(one(wrong)).evidence.at(0).code, "other-impacts");
    EXPECT_EQ(assessed(one(wrong), {}, 1.0).verdict, Verdict::agrees) << "a tolerance is met";
    EXPECT_EQ(assessed({{0.02, {run(0.02, 0.3)}}, {0.01, {wrong}}}).verdict, Verdict::disagrees);
    EXPECT_EQ(assessed({{0.01, {wrong}}, {0.005, {run(0.005, 0.1)}}}).verdict, Verdict::not_claimed)
        << "the finest history decides";
  }
  const HistoryFacts away{.first = 1.0, .start_error = 0.5};
  EXPECT_EQ(assessed(one(run(0.01, 0.3)), {}, {}, away).verdict, Verdict::disagrees);
  const HistoryFacts sparse{.rows_resolve_impacts = false};
  EXPECT_EQ(assessed(one(missed), {}, {}, sparse).verdict, Verdict::not_claimed);
  EXPECT_EQ(assessed(one(missed), {}, {}, sparse).reason, "sparse-rows");
  EXPECT_EQ(assessed(one(run(0.01, 0.3))).verdict, Verdict::not_claimed);
}

TEST(JudgeHistories, AFloorOfCompliantContactsAgreesWithAnExpectedFloor) {
  const auto found =
      judge(levels(2.0, 0.1), any_floor, {.contact_time = 0.05, .finest = HistoryFacts{}});
  EXPECT_EQ(found.verdict, Verdict::agrees);
  EXPECT_EQ(found.reason, "contact-stiffness");
}

TEST(JudgeHistories, ACauseAgainstAClaimIsTheLeastVerdict) {
  const auto judged = [&](Verdict least, const Claim& claim) {
    return judge(
        levels(2.0), claim,
        {.finest = HistoryFacts{}, .cause_against = "gap-differs", .least_verdict = least});
  };
  EXPECT_EQ(judged(Verdict::undecided, proper_2).verdict, Verdict::undecided);
  EXPECT_EQ(judged(Verdict::undecided, proper_2).reason, "gap-differs");
  EXPECT_EQ(judged(Verdict::disagrees, proper_2).verdict, Verdict::disagrees);
  EXPECT_EQ(judged(Verdict::not_claimed, proper_2).verdict, Verdict::agrees);
  EXPECT_EQ(judged(Verdict::disagrees, {}).verdict, Verdict::not_claimed);
}

TEST(JudgeHistories, NoLadderShowsNoOrder) {
  for (const auto& claim : {proper_2, Claim{}}) {
    const auto found =
        judge(levels(2.0), claim, {.finest = HistoryFacts{}, .no_ladder = "step-without-effect"});
    EXPECT_EQ(found.verdict, Verdict::undecided);
    EXPECT_EQ(found.reason, "step-without-effect");
    for (const auto& fit : {found.displacement, found.velocity}) {
      EXPECT_EQ(fit.behaviour, Behaviour::undecided);
      EXPECT_FALSE(fit.has_line);
    }
  }
  const auto met =
      judge(levels(2.0), {}, {.tolerance = 1.0, .finest = HistoryFacts{}, .no_ladder = "odd-file"});
  EXPECT_EQ(met.verdict, Verdict::agrees);
}

TEST(JudgeHistories, ContactsOfFewStepsDoNotDenyAFloor) {
  const auto judged = [&](double steps) {
    const double contact = steps * levels(1.0).back().runs.back().step;
    return judge(levels(1.0), any_floor, {.contact_time = contact, .finest = HistoryFacts{}});
  };
  EXPECT_EQ(judged(100.0).verdict, Verdict::undecided);
  EXPECT_EQ(judged(100.0).reason, "contact-not-resolved");
  EXPECT_EQ(judged(200.0).verdict, Verdict::disagrees);
}

}  // namespace
}  // namespace clackers::judge
