#include "clackers/judge/convergence/judge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/judge/testing/synthetic_ladder.hpp"

namespace clackers::judge {
namespace {

using namespace synthetic;

// Scores whose displacement error is `error(h)`, with velocity and impact times in proportion and
// all six impacts found.
measure::Ladder scores(const std::function<double(double)>& error, const Shape& shape = {}) {
  measure::Ladder made;
  for (const auto& level : ladder(error, shape)) {
    made.push_back({level.front().step, {}});
    for (const auto& point : level) {
      measure::RunScore run;
      run.step = point.step;
      run.finished = true;
      run.u_error = point.error;
      run.v_error = 2.0 * point.error;
      run.rounding_floor = point.floor;
      run.impacts = measure::ImpactScore{.expected = 6, .found = 6, .matched = 6};
      run.impacts->worst_time_error = 3.0 * point.error;
      made.back().runs.push_back(run);
    }
  }
  return made;
}

auto power(double q) {
  return [q](double h) { return std::pow(h, q); };
}

// A run of an undamped motion that ends with `ratio` times its energy.
void grown(measure::RunScore& run, double ratio) {
  run.energy_ratio = ratio;
  run.energy_error = ratio - 1.0;
}

void every_run(measure::Ladder& ladder, std::size_t from_level,
               const std::function<void(measure::RunScore&)>& change) {
  for (std::size_t i = from_level; i < ladder.size(); ++i)
    for (auto& run : ladder[i].runs) change(run);
}

const Claim second{Behaviour::proper, 2.0, ""}, fourth{Behaviour::proper, 4.0, ""},
    rough{Behaviour::irregular, 1.0, ""},
    floor_claim{Behaviour::stagnating, 0.0, "contact-stiffness"};

TEST(Judge, AnOrderOfLargeErrorsThatStillRisesIsUndecided) {
  const auto judged = [](double size) {
    const auto error = [size](double h) {
      const double octaves = std::log2(0.05 / h);
      return size * std::exp2(-0.9 * octaves - 0.015 * octaves * octaves);
    };
    return judge(scores(error, {.levels = 4, .samples = 1}), second, {});
  };
  const auto coarse = judged(1.0);
  EXPECT_EQ(coarse.verdict, Verdict::undecided);
  EXPECT_EQ(coarse.reason, "too-few-levels");
  EXPECT_EQ(judged(0.01).verdict, Verdict::disagrees);
}

// Errors of first order that end in a rough floor which nothing explains: noise, or another system.
TEST(Judge, ALineAboveALargeRoughFloorIsUndecided) {
  const auto judged = [](double floor, int levels) {
    const auto error = [=](double h) { return std::max(0.2 * h, floor); };
    return judge(scores(error, {.levels = levels, .coarsest = 3.2}), rough);
  };
  const auto small = judged(0.0184, 6), large = judged(0.045, 6);
  EXPECT_GT(large.displacement.floor_step, 0.0);
  EXPECT_EQ(small.verdict, Verdict::agrees);
  EXPECT_EQ(large.verdict, Verdict::undecided);
}

TEST(Judge, WhatIsClaimedAndFoundAgrees) {
  const auto found = judge(scores(power(2.0)), second);
  EXPECT_EQ(found.verdict, Verdict::agrees);
  EXPECT_EQ(found.displacement.behaviour, Behaviour::proper);
  EXPECT_EQ(found.velocity.behaviour, Behaviour::proper);
  EXPECT_EQ(found.impact_time.behaviour, Behaviour::proper);
  EXPECT_NEAR(found.velocity.constant, 2.0, 1e-9);
  EXPECT_NEAR(found.impact_time.constant, 3.0, 1e-9);
  EXPECT_TRUE(found.reason.empty());
  EXPECT_TRUE(found.evidence.empty());
}

TEST(Judge, TheOrderOfVelocitiesIsAClaimOfItsOwn) {
  auto runs = scores(power(2.0));
  every_run(runs, 0, [](measure::RunScore& run) { run.v_error = 0.3 * run.step; });
  const auto verdict = [&](Claim claim) { return judge(runs, claim).verdict; };
  const auto undecided = Behaviour::undecided, proper = Behaviour::proper;
  EXPECT_EQ(verdict({undecided, 0.0, {}, 1.0}), Verdict::agrees);
  EXPECT_EQ(verdict({undecided, 0.0, {}, 2.0}), Verdict::disagrees);
  EXPECT_EQ(verdict({proper, 2.0, {}, 1.0}), Verdict::agrees);
  EXPECT_EQ(verdict({proper, 2.0, {}, 2.0}), Verdict::disagrees);
  EXPECT_EQ(verdict({proper, 1.0, {}, 1.0}), Verdict::disagrees);
  const auto found = judge(runs, {undecided, 0.0, {}, 1.0});
  ASSERT_EQ(found.evidence.size(), 1u);
  EXPECT_EQ(found.evidence[0].code, "velocity-order");
  EXPECT_NEAR(found.evidence[0].numbers.at(0), 1.0, 1e-9);
  EXPECT_EQ(found.evidence[0].numbers.at(2), 1.0);
  EXPECT_EQ(judge(runs, second).evidence.at(0).code, "velocity-order-lower");
  every_run(runs, 0, [](measure::RunScore& run) { run.v_error = 1e-3; });
  EXPECT_EQ(verdict({proper, 2.0, {}, 1.0}), Verdict::disagrees);
}

TEST(Judge, ALineOfAWideIntervalDecidesNothing) {
  // One run a level, of order two until a term of order one rules.
  const auto bent = [](double term) {
    return judge(scores([=](double h) { return h * h + term * h; }, {.levels = 5, .samples = 1}),
                 second);
  };
  EXPECT_EQ(bent(3e-4).verdict, Verdict::agrees);
  const auto wide = bent(1e-3);
  EXPECT_EQ(wide.verdict, Verdict::undecided);
  EXPECT_NEAR(wide.displacement.order, 1.91, 0.01);
  EXPECT_GT(wide.displacement.spread, 2.0 / 3.0);
}

TEST(Judge, AnotherOrderDisagreesInBothDirections) {
  const auto lower = judge(scores(power(1.0)), second);
  EXPECT_EQ(lower.verdict, Verdict::disagrees);
  EXPECT_EQ(lower.displacement.behaviour, Behaviour::reduced);
  const auto higher = judge(scores(power(4.0), {.levels = 6}), second);
  EXPECT_EQ(higher.verdict, Verdict::disagrees);
  EXPECT_EQ(higher.displacement.behaviour, Behaviour::proper);
}

TEST(Judge, FasterDisplacementsAgreeWhereVelocitiesAreAsClaimed) {
  auto ladder = scores(power(3.0), {.levels = 6});
  const auto velocities_of = [&](double order) {
    for (auto& level : ladder)
      for (auto& run : level.runs) run.v_error = std::pow(run.step, order);
    return judge(ladder, second).verdict;
  };
  EXPECT_EQ(velocities_of(2.0), Verdict::agrees);
  EXPECT_EQ(velocities_of(3.0), Verdict::disagrees);
  EXPECT_EQ(velocities_of(1.0), Verdict::disagrees);
}

// Until steps are shorter than the time between impacts their order is won and lost.
TEST(Judge, StepsLongerThanBetweenImpactsDoNotCount) {
  const auto error = [](double h) {
    return h > 2e-3 ? std::sqrt(h) * (1.0 + 0.5 * std::sin(1.0 / h)) : 50.0 * h * h;
  };
  const JudgeContext close{.closest_impacts = 1e-3};
  EXPECT_EQ(judge(scores(error, {.levels = 7}), second, {}).verdict, Verdict::disagrees);
  const auto few = judge(scores(error, {.levels = 7}), second, close);
  EXPECT_EQ(few.verdict, Verdict::undecided);
  EXPECT_EQ(few.reason, "too-few-levels");
  const auto enough = judge(scores(error, {.levels = 10}), second, close);
  EXPECT_EQ(enough.verdict, Verdict::agrees);
  EXPECT_NEAR(enough.displacement.order, 2.0, 0.01);
  // What agrees needs no such steps, and a lower order stays one.
  EXPECT_EQ(judge(scores(power(2.0), {.levels = 5}), second, close).verdict, Verdict::agrees);
  EXPECT_EQ(judge(scores(power(1.0), {.levels = 10}), second, close).verdict, Verdict::disagrees);
  // Those of an irregular method are a 32nd of it.
  EXPECT_EQ(judge(scores(power(0.5), {.levels = 7}), rough, close).verdict, Verdict::undecided);
  EXPECT_EQ(judge(scores(power(0.5), {.levels = 15}), rough, close).verdict, Verdict::disagrees);
}

// Rounding of second differences: 2^-52 of the displacement over the square of the step.
TEST(Judge, RoundingThatGrowsIsExactWhereThatIsClaimed) {
  const auto growing = [](double factor) {
    return scores([=](double h) { return factor * 0x1p-52 * std::pow(20.0 / h, 2.0); });
  };
  const Claim exact{Behaviour::exact, 0.0, ""};
  EXPECT_EQ(judge(growing(1.0), exact).displacement.behaviour, Behaviour::exact);
  EXPECT_EQ(judge(growing(1.0), exact).verdict, Verdict::agrees);
  EXPECT_EQ(judge(growing(100.0), exact).verdict, Verdict::disagrees);
  EXPECT_EQ(judge(growing(1.0), second).displacement.behaviour, Behaviour::divergent);
  // A floor of printed digits is no number of steps.
  auto printed = growing(1e4);
  for (auto& level : printed)
    for (auto& run : level.runs) run.rounding_floor = 1e-7;
  JudgeContext file;
  file.finest = HistoryFacts{.rows = 1000, .printed_floor = 1e-7};
  EXPECT_NE(judge(printed, exact, file).verdict, Verdict::agrees);
  // Of coarse steps it may rise above the floor, below which it is then.
  const auto late = scores(
      [](double h) { return 0x1p-52 * (20.0 / h) * rounding_slack * std::pow(h / 0.02, 0.1); },
      {.levels = 8});
  EXPECT_EQ(judge(late, second).reason, "too-few-levels");
  EXPECT_EQ(judge(late, exact).displacement.behaviour, Behaviour::exact);
  EXPECT_EQ(judge(late, exact).verdict, Verdict::agrees);
}

TEST(Judge, AnOrderWithinATenthAgrees) {
  EXPECT_EQ(judge(scores(power(1.81)), second).verdict, Verdict::agrees);
  EXPECT_EQ(judge(scores(power(2.19)), second).verdict, Verdict::agrees);
  EXPECT_EQ(judge(scores(power(1.79)), second).verdict, Verdict::disagrees);
  EXPECT_EQ(judge(scores(power(2.21)), second).verdict, Verdict::disagrees);
}

TEST(Judge, AReducedOrderMayBeClaimed) {
  const Claim reduced{Behaviour::reduced, 1.5, ""};
  const auto found = judge(scores(power(1.5)), reduced);
  EXPECT_EQ(found.verdict, Verdict::agrees);
  EXPECT_EQ(found.displacement.behaviour, Behaviour::reduced);
  EXPECT_EQ(judge(scores(power(2.0)), reduced).verdict, Verdict::disagrees);
  EXPECT_EQ(judge(scores(power(2.0)), reduced).displacement.behaviour, Behaviour::proper);
  EXPECT_EQ(judge(scores(power(1.0)), reduced).verdict, Verdict::disagrees);
}

TEST(Judge, AnIrregularClaimIsComparedWithTheEnvelope) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Scatter scatter(20.0, seed), again(20.0, seed);
    const auto found = judge(scores([&](double h) { return h / scatter(); }), rough);
    EXPECT_NE(found.verdict, Verdict::disagrees);
    EXPECT_EQ(found.displacement.behaviour, Behaviour::irregular);
    const auto claims_line = judge(scores([&](double h) { return h / again(); }), second);
    EXPECT_EQ(claims_line.verdict, Verdict::disagrees);
  }
}

TEST(Judge, AnEnvelopeOfHalfTheOrderDisagreesAndOneTooUncertainIsUndecided) {
  Scatter scatter(10.0, 1), wild(1e4, 2);
  const auto half = judge(scores([&](double h) { return std::sqrt(h) / scatter(); }), rough);
  EXPECT_EQ(half.displacement.behaviour, Behaviour::irregular);
  EXPECT_EQ(half.verdict, Verdict::disagrees);
  const auto few = judge(scores([&](double h) { return h / wild(); }, {.levels = 4}), rough);
  EXPECT_EQ(few.verdict, Verdict::undecided);
}

// Rough levels whose largest errors lie at factor e^(+-0.2) around h^order, in the pattern + - - +
// that leaves the slope as it is: residuals 0.2 and a squared standard error 4 * 0.04 / 2 / (5 ln2^2)
// = 0.0333 of two degrees of freedom. The raw errors have the variance (22.4 - 1.28 + 1.28) / 30 =
// 0.748 about the line, so a range of sqrt(12 * 0.748) and of the largest of eight the variance
// 8.97 * 8 / 810 = 0.0886, over 5 ln2^2 the square 0.0369. Both together, 0.0351, with t = 2.78 of
// four degrees of freedom give a spread of 0.52; the steps of a level change the raw variance a little.
measure::Ladder uncertain(double order) {
  auto made = scores(power(order), {.levels = 4});
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 8; ++j) {
      auto& run = made[i].runs[j];
      run.u_error = std::pow(made[i].step, order) * std::exp(i == 0 || i == 3 ? 0.2 : -0.2);
      if (j > 0) run.u_error /= j % 2 == 0 ? 3.0 : 10.0;
    }
  return made;
}

TEST(Judge, AnEnvelopeThatMayBeAnythingIsUndecided) {
  for (const double order : {1.0, 1.3}) {
    const auto found = judge(uncertain(order), rough);
    EXPECT_EQ(found.displacement.behaviour, Behaviour::irregular);
    EXPECT_NEAR(found.displacement.order, order, 1e-9);
    EXPECT_NEAR(found.displacement.spread, 0.52, 0.03);
    EXPECT_EQ(found.verdict, Verdict::undecided);
  }
}

TEST(Judge, WhatTheFitNoticesIsEvidence) {
  const auto numbers = [](const Assessment& found, std::string_view code) {
    const auto at = std::ranges::find(found.evidence, code, &Evidence::code);
    return at == found.evidence.end() ? std::vector<double>() : at->numbers;
  };
  const auto few = judge(uncertain(1.0), rough);
  EXPECT_EQ(few.reason, "more-samples");
  EXPECT_EQ(numbers(few, "more-samples"),
            (std::vector<double>{few.displacement.order, few.displacement.spread}));
  const auto unstable = judge(scores([](double h) { return h > 0.011 ? 1e9 : h * h; }), second);
  EXPECT_EQ(numbers(unstable, "unstable-coarse-steps"),
            std::vector<double>{unstable.displacement.stable_step});
  const auto flat = scores([](double h) { return 0.2 + 1e-3 * h; });
  const double finest = flat.back().runs.back().step, contact = 15.0 * finest;
  EXPECT_EQ(numbers(judge(flat, floor_claim, {.contact_time = contact}), "steps-per-contact"),
            (std::vector<double>{contact / finest, contact}));
}

// Errors that a compliant contact left of two buildings, coarse steps first: a floor of two octaves
// behind errors larger than the motion, whose envelope has the order 0.8 +- 3.
TEST(Judge, OnlyErrorsThatFallForCertainContradictAFloor) {
  const double errors[8][8] = {{6.71, 9.65, 8.44, 0.616, 26.5, 10.2, 6.96, 1.12},
                               {7.85, 1.16, 1.11, 6.92, 18.7, 2.86, 1.11, 1.04},
                               {15.9, 0.654, 0.68, 0.862, 5.29, 1.25, 0.595, 0.677},
                               {0.962, 2.1, 0.455, 0.461, 0.28, 0.113, 0.0707, 0.0719},
                               {0.102, 0.118, 0.108, 0.198, 0.0989, 0.0477, 0.0631, 0.0766},
                               {0.0857, 0.0455, 0.0519, 0.0449, 0.0515, 0.0444, 0.0443, 0.0441},
                               {0.044, 0.0439, 0.0438, 0.0437, 0.0436, 0.0436, 0.0435, 0.0435},
                               {0.0435, 0.0434, 0.0434, 0.0434, 0.0434, 0.0434, 0.0433, 0.0433}};
  auto made = scores(power(1.0), {.levels = 8});
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t j = 0; j < 8; ++j) made[i].runs[j].u_error = errors[i][j];
  const auto found = judge(made, floor_claim);
  EXPECT_EQ(found.displacement.behaviour, Behaviour::undecided);
  EXPECT_EQ(found.displacement.reason, "more-samples");
  EXPECT_EQ(found.verdict, Verdict::undecided);
  EXPECT_EQ(judge(uncertain(1.0), floor_claim).verdict, Verdict::disagrees);
}

TEST(Judge, ImpactTimesHaveNoSizeOfTheMotion) {
  auto late = scores(power(2.0));
  every_run(late, 0, [](measure::RunScore& run) { run.impacts->worst_time_error = 1.5; });
  EXPECT_EQ(judge(late, second).impact_time.behaviour, Behaviour::stagnating);
}

TEST(Judge, WhatIsUndecidedStaysSoWhateverEnergyAndImpacts) {
  auto unresolved = scores([](double h) { return 0.3 + h; });
  every_run(unresolved, 0, [](measure::RunScore& run) {
    grown(run, 8.0);
    run.impacts->missed = 1;
  });
  const auto found = judge(unresolved, floor_claim, {.contact_time = 1e-4});
  EXPECT_EQ(found.displacement.reason, "contact-not-resolved");
  EXPECT_EQ(found.verdict, Verdict::undecided);
}

TEST(Judge, AnExactMotionAtRestMayEndWithAnyEnergyRatio) {
  auto exact = scores([](double) { return 1e-16; });
  every_run(exact, 0, [](measure::RunScore& run) { grown(run, 8.0); });
  EXPECT_EQ(judge(exact, {Behaviour::exact, 0.0, ""}).verdict, Verdict::agrees);
}

TEST(Judge, ALineOfTheOrderIsATighterEnvelopeThanClaimed) {
  const auto found = judge(scores(power(1.0)), rough);
  EXPECT_EQ(found.displacement.behaviour, Behaviour::proper);
  EXPECT_EQ(found.verdict, Verdict::agrees);
  EXPECT_EQ(judge(scores(power(2.0)), rough).verdict, Verdict::disagrees);
  EXPECT_EQ(judge(scores(power(2.0)), rough).mismatch, Mismatch::behaviour);
}

TEST(Judge, AFloorAgreesOnlyForTheClaimedReason) {
  const auto flat = scores([](double h) { return 0.3 + h; });
  const auto found = judge(flat, floor_claim, {.contact_time = 0.0157});
  EXPECT_EQ(found.verdict, Verdict::agrees);
  EXPECT_EQ(found.displacement.reason, "contact-stiffness");
  EXPECT_EQ(judge(flat, floor_claim).verdict, Verdict::disagrees);
  const Claim tolerance{Behaviour::stagnating, 0.0, "tolerance-floor"};
  EXPECT_EQ(judge(flat, tolerance).verdict, Verdict::agrees);
}

TEST(Judge, AnUnresolvedContactIsUndecided) {
  const auto found =
      judge(scores([](double h) { return 0.3 + h; }), floor_claim, {.contact_time = 1e-4});
  EXPECT_EQ(found.verdict, Verdict::undecided);
  EXPECT_EQ(found.displacement.reason, "contact-not-resolved");
}

TEST(Judge, WithoutAClaimNothingIsCompared) {
  const auto found = judge(scores(power(1.0)), {});
  EXPECT_EQ(found.verdict, Verdict::not_claimed);
  EXPECT_EQ(found.displacement.behaviour, Behaviour::proper);
}

TEST(Judge, AnExactMotionAgreesWithTheClaimOfOneAndTellsNothingOfAnOrder) {
  const auto exact = scores([](double) { return 1e-16; });
  EXPECT_EQ(judge(exact, {Behaviour::exact, 0.0, ""}).verdict, Verdict::agrees);
  const auto found = judge(exact, second);
  EXPECT_EQ(found.verdict, Verdict::undecided);
}

TEST(Judge, MissedOrExtraImpactsOnTheFinestLevelsDisagree) {
  for (const bool extra : {false, true})
    for (const std::size_t level : {6u, 7u}) {
      auto ladder = scores(power(2.0));
      auto& impacts = *ladder[level].runs[5].impacts;
      (extra ? impacts.extra : impacts.missed) = 1;
      if (!extra) impacts.matched = impacts.found = 5;
      const auto found = judge(ladder, second);
      EXPECT_EQ(found.verdict, Verdict::disagrees) << level;
      ASSERT_EQ(found.evidence.size(), 1u);
      EXPECT_EQ(found.evidence[0].code, "impacts-miscounted");
      const auto& run = ladder[level].runs[5];
      EXPECT_EQ(found.evidence[0].numbers,
                (std::vector{run.step, extra ? 6.0 : 5.0, 6.0, extra ? 1.0 : 0.0}));
    }
  auto coarse = scores(power(2.0));
  coarse[5].runs[0].impacts->missed = 1;
  EXPECT_EQ(judge(coarse, second).verdict, Verdict::agrees);
}

TEST(Judge, AnUndecidedLadderDisagreesOnlyWhereAllRunsMissAsManyImpacts) {
  auto ladder = scores(power(2.0), {.levels = 2});
  every_run(ladder, 0, [](measure::RunScore& run) { run.impacts->missed = 1; });
  EXPECT_EQ(judge(ladder, second).verdict, Verdict::disagrees);
  ladder[1].runs[3].impacts->missed = 2;
  EXPECT_EQ(judge(ladder, second).verdict, Verdict::undecided);
}

// The numbers of the evidence of that code; empty without any.
std::vector<double> numbers(const Assessment& found, std::string_view code) {
  for (const auto& evidence : found.evidence)
    if (evidence.code == code) return evidence.numbers;
  return {};
}

TEST(Judge, ErrorsOverTolerancesAreThoseOfTheLine) {
  const Claim claim{Behaviour::proper, 1.0, ""};
  const auto error = [](double tolerance) { return 3.0 * tolerance; };
  auto ladder = scores(error, {.levels = 8, .samples = 1});
  ladder[3].runs[0].finished = false;
  const auto found = numbers(judge(ladder, claim, {.by_tolerance = true}), "error-over-tolerance");
  ASSERT_EQ(found.size(), 3u);
  for (const double factor : found) EXPECT_NEAR(factor, 3.0, 1e-12);
  EXPECT_TRUE(numbers(judge(ladder, claim), "error-over-tolerance").empty());
  const auto flat = scores([](double) { return 1e-3; }, {.levels = 8, .samples = 1});
  EXPECT_TRUE(numbers(judge(flat, claim, {.by_tolerance = true}), "error-over-tolerance").empty());
}

TEST(Judge, AStepAtWhichErrorsCancelIsReported) {
  const auto error = [](double h) { return 1e-4 * std::abs(1.0 - std::pow(h / 0.0013, 2)); };
  const auto found = numbers(judge(scores(error), second), "errors-cancel");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0], 0.0013, 1e-6);
}

TEST(Judge, LateImpactsDoNotContradictAFloorButMissedOnesDo) {
  auto late = scores([](double) { return 0.9; });
  every_run(late, 0, [](measure::RunScore& run) {
    run.impacts = measure::ImpactScore{6, 6, 2, 4, 4};
  });
  EXPECT_EQ(judge(late, floor_claim, {.contact_time = 0.0157}).verdict, Verdict::agrees);
  every_run(late, 0, [](measure::RunScore& run) {
    run.impacts = measure::ImpactScore{6, 2, 2, 4, 0};
  });
  EXPECT_EQ(judge(late, floor_claim, {.contact_time = 0.0157}).verdict, Verdict::disagrees);
}

TEST(Judge, AFloorThatIsNotSmallWinsAndLosesImpacts) {
  const auto verdict = [](double floor, long long found) {
    auto flat = scores([&](double) { return floor; });
    every_run(flat, 0, [&](measure::RunScore& run) {
      run.impacts = measure::ImpactScore{6, found, 2, 4, found - 2};
    });
    return judge(flat, floor_claim, {.contact_time = 0.0157}).verdict;
  };
  EXPECT_EQ(verdict(0.02, 9), Verdict::agrees);
  EXPECT_EQ(verdict(0.02, 10), Verdict::disagrees);
  EXPECT_EQ(verdict(0.02, 3), Verdict::agrees);
  EXPECT_EQ(verdict(0.02, 2), Verdict::disagrees);
  EXPECT_EQ(verdict(0.005, 7), Verdict::disagrees);
}

TEST(Judge, AnEnvelopeOfNoOrderIsOpenWhileImpactsAreWonAndLost) {
  const auto found = [](double scale, double order, std::size_t wrong) {
    Scatter scatter(2.0, 5);
    auto ladder = scores([&](double h) { return scale * std::pow(h, order) / scatter(); });
    for (std::size_t k = 0; k < wrong; ++k)
      ladder.back().runs[k].impacts = measure::ImpactScore{6, 7, 6, 0, 1};
    return judge(ladder, second);
  };
  EXPECT_EQ(found(1.0, 0.5, 5).verdict, Verdict::undecided);
  EXPECT_EQ(found(1.0, 0.5, 5).reason, "too-few-levels");
  EXPECT_EQ(found(1.0, 0.5, 4).verdict, Verdict::disagrees);
  EXPECT_EQ(found(0.1, 0.5, 5).verdict, Verdict::disagrees);
  EXPECT_EQ(found(1e2, 1.0, 5).verdict, Verdict::disagrees);
}

// Errors that stay near a twentieth of the motion until impacts are told apart, then fall by order one.
TEST(Judge, AnEnvelopeIsThatOfTheFinerHalfWhereCoarseErrorsAreLarge) {
  const auto found = [](int levels, double scale, double order) {
    Scatter scatter(8.0, 5);
    const auto error = [&](double h) {
      const double small = scale * std::pow(h, order) / scatter();
      return small / (1.0 + small / 0.05);
    };
    return judge(scores(error, {.levels = levels}), rough);
  };
  EXPECT_EQ(found(12, 40.0, 1.0).verdict, Verdict::agrees);
  EXPECT_GE(found(12, 40.0, 1.0).displacement.first_level, 6);
  EXPECT_EQ(found(14, 2.0, 0.5).verdict, Verdict::disagrees);
}

TEST(Judge, ALineOfAWideIntervalDecidesForAnEnvelope) {
  Scatter scatter(1.3, 3);
  const auto error = [&](double h) { return 20.0 * h / (1.0 + 24.0 * h) * scatter(); };
  const auto found = judge(scores(error, {.coarsest = 0.14}), rough);
  EXPECT_FALSE(found.displacement.on_envelope);
  EXPECT_GT(found.displacement.spread, line_spread);
  EXPECT_EQ(found.verdict, Verdict::agrees);
}

// Levels at which runs miss impacts tell nothing of the order behind them.
TEST(Judge, AnEnvelopeBeginsBehindTheLevelsThatMiscountImpacts) {
  const auto found = [](std::size_t miscounting, std::size_t runs, double size = 1.0) {
    Scatter scatter(8.0, 5);
    const auto error = [&](double h) {
      const double small = 20.0 * h / scatter();
      return size * small / (1.0 + small / 0.2);
    };
    auto ladder = scores(error, {.levels = 7});
    for (std::size_t i = 0; i < miscounting; ++i)
      for (std::size_t k = 0; k < runs; ++k)
        ladder[i].runs[k].impacts = measure::ImpactScore{6, 7, 6, 0, 1};
    return judge(ladder, rough);
  };
  EXPECT_EQ(found(0, 8).verdict, Verdict::undecided);
  const auto behind = found(3, 8);
  EXPECT_EQ(behind.verdict, Verdict::agrees);
  EXPECT_EQ(behind.displacement.first_level, 3);
  EXPECT_EQ(behind.displacement.errors.size(), 7u);
  EXPECT_EQ(found(3, 3).verdict, Verdict::agrees);
  EXPECT_EQ(found(3, 2).verdict, Verdict::undecided) << "a quarter of the runs";
  EXPECT_EQ(found(3, 8, 0.02).verdict, Verdict::undecided) << "small errors";
  EXPECT_EQ(found(4, 8).verdict, Verdict::undecided);
  EXPECT_EQ(found(4, 8).reason, "too-few-levels");
}

// While impacts are won and lost, errors stand as if at a floor.
TEST(Judge, AFloorOfMiscountedImpactsIsNone) {
  const auto found = [](std::size_t miscounting, double size = 0.06) {
    const auto error = [&](double h) {
      const double finer = 16.0 * h / 0.05;
      return size * (finer > 1.01 ? 1.0 + 0.3 * std::sin(1.0 / h) : finer);
    };
    auto ladder = scores(error, {.levels = 5});
    for (std::size_t i = 0; i < miscounting; ++i)
      for (auto& run : ladder[i].runs) run.impacts = measure::ImpactScore{6, 7, 6, 0, 1};
    return judge(ladder, {Behaviour::proper, 1.0, ""});
  };
  EXPECT_EQ(found(0).displacement.behaviour, Behaviour::stagnating);
  EXPECT_EQ(found(0).verdict, Verdict::disagrees);
  EXPECT_EQ(found(4).displacement.behaviour, Behaviour::undecided);
  EXPECT_EQ(found(4).verdict, Verdict::undecided);
  EXPECT_EQ(found(4).reason, "too-few-levels");
  EXPECT_EQ(found(5).verdict, Verdict::disagrees) << "on the finest level, too";
  EXPECT_EQ(found(4, 0.009).verdict, Verdict::disagrees) << "small errors";
}

TEST(Judge, AnOpenEnvelopeOfLargeErrorsAsksForFinerLevels) {
  const auto reason = [](double scale) {
    Scatter wild(30.0, 4);
    const auto found =
        judge(scores([&](double h) { return scale * std::pow(h, 0.6) / wild(); }), rough);
    EXPECT_EQ(found.verdict, Verdict::undecided);
    EXPECT_TRUE(found.displacement.on_envelope);
    return found.reason;
  };
  EXPECT_EQ(reason(5.0), "too-few-levels");
  EXPECT_EQ(reason(0.5), "more-samples");
}

// Steps that do not resolve a contact find some impacts of it by chance, on an envelope that falls.
TEST(Judge, ContactsThatAreNotResolvedMiscountImpacts) {
  Scatter scatter(8.0, 5);
  auto ladder = scores([&](double h) { return 10.0 * h / scatter(); });
  ladder.back().runs.back().impacts = measure::ImpactScore{6, 7, 6, 0, 1};
  EXPECT_EQ(judge(ladder, floor_claim, {.contact_time = 1e-3}).verdict, Verdict::undecided);
  EXPECT_EQ(judge(ladder, floor_claim, {.contact_time = 1e-3}).reason, "contact-not-resolved");
}

TEST(Judge, LostEnergyIsNoGrowth) {
  auto flat = scores([](double h) { return 0.3 + h; });
  every_run(flat, 6, [](measure::RunScore& run) { run.energy_ratio = 0.4; });
  EXPECT_EQ(judge(flat, second).displacement.behaviour, Behaviour::stagnating);
  auto falling = scores([](double h) { return 1.3 * std::tanh(700.0 * h); });
  every_run(falling, 6, [](measure::RunScore& run) { run.energy_ratio = 0.4; });
  const auto found = judge(falling, second);
  EXPECT_EQ(found.displacement.behaviour, Behaviour::undecided);
  EXPECT_EQ(found.reason, "numerical-damping");
  EXPECT_EQ(found.verdict, Verdict::undecided);
}

TEST(Judge, EnergyThatGrowsWhileErrorsDoNotFallDiverges) {
  for (const double ratio : {2.1, 8.0}) {
    auto ladder = scores([](double h) { return 1.7 + h; });
    every_run(ladder, 6, [&](measure::RunScore& run) { grown(run, ratio); });
    const auto found = judge(ladder, second);
    EXPECT_EQ(found.displacement.behaviour, Behaviour::divergent);
    EXPECT_EQ(found.displacement.reason, "energy-growth");
    EXPECT_EQ(found.verdict, Verdict::disagrees);
  }
}

// Of a compliant law that is resolved, the model is another.
TEST(Judge, EnergyOfAFarLimitOfACompliantLawIsOfTheModel) {
  const auto judged = [](auto error, const Claim& claim = {}) {
    auto ladder = scores(error);
    every_run(ladder, 0, [](measure::RunScore& run) { grown(run, 160.0); });
    return judge(ladder, claim, {.contact_time = 0.25}).displacement;
  };
  const auto limit = judged([](double h) { return 1.1 + h * h; });
  EXPECT_EQ(limit.behaviour, Behaviour::stagnating);
  EXPECT_EQ(limit.reason, "contact-stiffness");
  EXPECT_NEAR(limit.floor, 1.1, 1e-3);
  EXPECT_EQ(judged([](double h) { return 1.1 * std::pow(h, -0.1); }).reason, "energy-growth");
  // A contact so soft that the motion is another one is not the floor that is claimed.
  EXPECT_EQ(judged([](double h) { return 1.1 + h * h; }, floor_claim).reason, "energy-growth");
}

TEST(Judge, AMotionThatDoesNotDecayAsItShouldHasNotGrown) {
  auto ladder = scores([](double h) { return 0.4 + 0.1 * h; });
  every_run(ladder, 0, [](measure::RunScore& run) {
    run.energy_ratio = 8.0;
    run.energy_error = 0.9;
  });
  EXPECT_EQ(judge(ladder, second).displacement.behaviour, Behaviour::stagnating);
}

TEST(Judge, EnergyDoesNotOverruleALineNorASingleLevelNorAMotionAtRest) {
  auto line = scores(power(2.0));
  every_run(line, 0, [](measure::RunScore& run) { grown(run, 8.0); });
  EXPECT_EQ(judge(line, second).verdict, Verdict::agrees);
  for (const std::size_t level : {6u, 7u}) {
    auto flat = scores([](double h) { return 0.3 + h; });
    for (auto& run : flat[level].runs) grown(run, 8.0);
    EXPECT_EQ(judge(flat, floor_claim, {.contact_time = 0.0157}).verdict, Verdict::agrees);
  }
  auto rest = scores([](double h) { return 0.3 + h; });
  every_run(rest, 0, [](measure::RunScore& run) { run.energy_ratio = nan; });
  EXPECT_EQ(judge(rest, floor_claim, {.contact_time = 0.0157}).verdict, Verdict::agrees);
}

TEST(Judge, ARunThatFailedHasNoErrorHoweverSmall) {
  auto ladder = scores(power(2.0));
  for (std::size_t level : {0u, 1u})
    for (auto& run : ladder[level].runs) {
      run.finished = false;
      run.u_error = run.v_error = 1e-9;
      run.failure_code = "diverged";
      run.failure = "left the finite numbers at t = 3 s.";
    }
  EXPECT_EQ(judge(ladder, second).verdict, Verdict::agrees);
  EXPECT_EQ(judge(ladder, second).displacement.first_level, 2);
  every_run(ladder, 0, [](measure::RunScore& run) { run.finished = false; });
  const auto found = judge(ladder, second);
  EXPECT_EQ(found.verdict, Verdict::undecided);
  EXPECT_EQ(found.displacement.reason, "run-failed");
}

TEST(Judge, WithoutReportedImpactsTheirTimesAreUndecided) {
  auto ladder = scores(power(2.0));
  every_run(ladder, 0, [](measure::RunScore& run) { run.impacts.reset(); });
  const auto found = judge(ladder, second);
  EXPECT_EQ(found.verdict, Verdict::agrees);
  EXPECT_EQ(found.impact_time.behaviour, Behaviour::undecided);
  EXPECT_FALSE(found.impact_time.has_line);
}

TEST(Judge, FewLevelsAreUndecided) {
  const auto found = judge(scores(power(2.0), {.levels = 3}), second);
  EXPECT_EQ(found.verdict, Verdict::undecided);
  EXPECT_EQ(judge({}, second).verdict, Verdict::undecided);
}

TEST(Judge, ADivergentClaimMayBeMade) {
  const auto found =
      judge(scores([](double h) { return 1e-6 / h; }), {Behaviour::divergent, 0.0, ""});
  EXPECT_EQ(found.verdict, Verdict::agrees);
  // A motion that was lost grows no further.
  const auto of_floor = [](double floor, Behaviour claimed) {
    const auto rough = [=](double h) { return floor * (1.0 + 0.3 * std::sin(1.0 / h)); };
    return judge(scores(rough), {claimed, 0.0, "energy-growth"});
  };
  EXPECT_EQ(of_floor(0.4, Behaviour::divergent).verdict, Verdict::agrees);
  EXPECT_EQ(of_floor(0.05, Behaviour::divergent).verdict, Verdict::disagrees);
  // So large a floor is no noise where the claim knows its reason.
  for (const auto claimed : {Behaviour::divergent, Behaviour::undecided}) {
    EXPECT_EQ(of_floor(0.05, claimed).displacement.behaviour, Behaviour::stagnating);
    EXPECT_EQ(of_floor(0.05, claimed).displacement.reason, "energy-growth");
    EXPECT_EQ(of_floor(0.005, claimed).displacement.reason, "noise-floor");
  }
  EXPECT_EQ(of_floor(0.05, Behaviour::stagnating).displacement.reason, "noise-floor");
}

// Impacts of one instant, taken one by one: exact until then, another motion after it.
const measure::SharedImpacts jump{{1.5, 4}, 1e-9, 0.8};
double as_large(double h) { return 1.3 + 0.2 * std::sin(1.0 / h); }

TEST(Judge, ErrorsThatComeFromSimultaneousImpactsDiverge) {
  const auto found = judge(scores(as_large), fourth, {.shared = jump});
  EXPECT_EQ(found.displacement.behaviour, Behaviour::divergent);
  EXPECT_EQ(found.reason, "simultaneous-impacts");
  EXPECT_EQ(found.verdict, Verdict::disagrees);
  ASSERT_EQ(found.evidence.size(), 1u);
  EXPECT_EQ(found.evidence[0].numbers, (std::vector<double>{1.5, 4.0, 1e-9, 0.8}));
  const Claim any_floor{Behaviour::stagnating, 0.0, ""}, diverges{Behaviour::divergent, 0.0, ""};
  for (const auto& claim : {any_floor, diverges})
    EXPECT_EQ(judge(scores(as_large), claim, {.shared = jump}).verdict, Verdict::agrees);
  EXPECT_EQ(judge(scores(as_large), floor_claim, {.shared = jump}).verdict, Verdict::disagrees);
}

TEST(Judge, OtherImpactsAfterSimultaneousOnesAreNoMiscount) {
  auto ladder = scores(as_large);
  every_run(ladder, 0, [](measure::RunScore& run) { run.impacts->extra = 5; });
  const Claim any_floor{Behaviour::stagnating, 0.0, ""};
  EXPECT_EQ(judge(ladder, any_floor, {.shared = jump}).verdict, Verdict::agrees);
}

TEST(Judge, StepsThatAreTooLargeStayUndecidedWithSimultaneousImpacts) {
  const auto behaviour = [](const measure::Ladder& ladder,
                            std::optional<measure::SharedImpacts> shared) {
    return judge(ladder, fourth, {.shared = shared}).displacement.behaviour;
  };
  EXPECT_EQ(behaviour(scores(as_large), {}), Behaviour::undecided);
  // The error is there before the impacts already, or is small after them.
  EXPECT_EQ(behaviour(scores(as_large), measure::SharedImpacts{{1.5, 4}, 0.03, 0.8}),
            Behaviour::undecided);
  EXPECT_EQ(behaviour(scores(as_large), measure::SharedImpacts{{1.5, 4}, 1e-9, 0.01}),
            Behaviour::undecided);
  // The errors fall at last, or there are too few levels.
  const auto falls = [](double h) { return std::min(1.3, 700.0 * h); };
  EXPECT_EQ(behaviour(scores(falls), jump), Behaviour::undecided);
  EXPECT_EQ(behaviour(scores(as_large, {.levels = 3}), jump), Behaviour::undecided);
}

TEST(Judge, WhatConvergesStaysWhatItIsWithSimultaneousImpacts) {
  EXPECT_EQ(judge(scores(power(4.0)), fourth, {.shared = jump}).verdict, Verdict::agrees);
}

TEST(Judge, AFloorThatComesFromSimultaneousImpactsHasThemAsItsReason) {
  const auto floor = [](double) { return 0.3; };
  const auto found = judge(scores(floor), fourth, {.shared = jump});
  EXPECT_EQ(found.displacement.behaviour, Behaviour::stagnating);
  EXPECT_EQ(found.reason, "simultaneous-impacts");
  EXPECT_EQ(judge(scores(floor), fourth).reason, "unexplained-floor");
}

// A gentle impact that comes too late to be matched is missed and extra.
TEST(Judge, AnEnvelopeMayMiscountAtAFewSteps) {
  const auto verdict = [](std::size_t wrong, const Claim& claim) {
    Scatter scatter(8.0, 3);
    auto ladder = scores([&](double h) { return h / scatter(); });
    for (std::size_t i = ladder.size() - 2; i < ladder.size(); ++i)
      for (std::size_t k = 0; k < wrong; ++k)
        ladder[i].runs[k].impacts = measure::ImpactScore{6, 6, 5, 1, 1};
    return judge(ladder, claim).verdict;
  };
  EXPECT_EQ(verdict(4, rough), Verdict::agrees);
  EXPECT_EQ(verdict(5, rough), Verdict::disagrees);
  auto line = scores(power(2.0)), straight = scores(power(1.0));
  for (auto* ladder : {&line, &straight})
    ladder->back().runs.back().impacts = measure::ImpactScore{6, 6, 5, 1, 1};
  EXPECT_EQ(judge(line, second).verdict, Verdict::disagrees);
  EXPECT_EQ(judge(straight, rough).verdict, Verdict::agrees);
}

// The fourth order of the flights at coarse steps, the second of kinks at fine ones.
TEST(Judge, AnEnvelopeIsThatOfTheFinerHalfWhereCoarseErrorsFallFaster) {
  const auto verdict = [](double kinks) {
    Scatter scatter(4.0, 5);
    return judge(
        scores([&](double h) { return 1e3 * std::pow(h, 4.0) + kinks * h * h / scatter(); },
               {.levels = 10, .coarsest = 0.1}),
        {Behaviour::irregular, 2.0, {}});
  };
  const auto found = verdict(0.02);
  EXPECT_EQ(found.verdict, Verdict::agrees);
  EXPECT_NEAR(found.displacement.order, 2.0, 0.4);
  EXPECT_GE(found.displacement.first_level, 5);
  EXPECT_EQ(found.displacement.errors.size(), 10u);
  EXPECT_EQ(verdict(0.0).verdict, Verdict::disagrees);
}

TEST(Judge, AnIrregularOrderIsOfImpacts) {
  const auto verdict = [](long long impacts, double order, const Claim& claim = rough) {
    auto ladder = scores(power(order));
    for (auto& level : ladder)
      for (auto& run : level.runs) run.impacts = measure::ImpactScore{impacts, impacts, impacts};
    return judge(ladder, claim).verdict;
  };
  EXPECT_EQ(verdict(0, 2.0), Verdict::agrees);
  EXPECT_EQ(verdict(0, 4.0, second), Verdict::disagrees);
  EXPECT_EQ(verdict(1, 2.0), Verdict::disagrees);
  EXPECT_EQ(verdict(0, 0.5), Verdict::disagrees);
}

TEST(Judge, AClaimToDivergeSaysNothingOfImpacts) {
  auto growth = scores([](double h) { return 1e-3 / h; });
  for (auto& run : growth.back().runs) run.impacts = measure::ImpactScore{6, 7, 6, 0, 1};
  EXPECT_EQ(judge(growth, {Behaviour::divergent, 0.0, {}}).verdict, Verdict::agrees);
}

TEST(Judge, AFloorAsLargeAsTheMotionComesFromItsSimultaneousImpacts) {
  const auto floor = scores([](double h) { return 0.9 + 0.01 * h; });
  const auto reason = [&](const std::optional<measure::SharedImpacts>& shared) {
    return judge(floor, floor_claim, {.contact_time = 10.0, .shared = shared}).reason;
  };
  EXPECT_EQ(reason(jump), "simultaneous-impacts");
  EXPECT_EQ(reason({}), "contact-stiffness");
}

// Backward Euler with a contact spring: the errors come from those of a motion that has died away, and
// end at 0.043 three levels later.
TEST(Judge, AClaimedFloorIsOpenWhileErrorsFallByNoOrder) {
  const std::vector<double> bend{0.806, 0.807, 0.808, 0.808, 0.735, 0.626,
                                 0.516, 0.386, 0.255, 0.156, 0.0937};
  const auto error = [&](double h) {
    const double level = std::log2(0.1 / h);
    const auto i = std::min(std::size_t(level + 1e-9), bend.size() - 2);
    return bend[i] * std::pow(bend[i + 1] / bend[i], level - double(i));
  };
  auto ladder = scores(error, {.levels = 11, .coarsest = 0.1});
  const auto found = judge(ladder, floor_claim);
  EXPECT_LT(found.displacement.order, 0.75);
  EXPECT_EQ(found.verdict, Verdict::undecided);
  ladder.back().runs.back().impacts = measure::ImpactScore{6, 7, 6, 0, 1};
  EXPECT_EQ(judge(ladder, floor_claim).verdict, Verdict::undecided);
  EXPECT_EQ(judge(scores(power(1.0)), floor_claim).verdict, Verdict::disagrees);
}

TEST(Judge, LargeErrorsOfOneOrderDecide) {
  const auto line = judge(scores([](double h) { return 1.9 * h; }, {.levels = 4, .coarsest = 0.5}),
                          {Behaviour::proper, 2.0, {}});
  EXPECT_EQ(line.verdict, Verdict::disagrees);
}

TEST(Judge, ErrorsWithinAFactorTwoOfTheClaimedLineAreProper) {
  const auto scattered = [](double factor) {
    return [draw = Scatter(factor, 7)](double h) mutable { return h * h * draw(); };
  };
  EXPECT_EQ(judge(scores(scattered(1.9)), second).verdict, Verdict::agrees);
  EXPECT_EQ(judge(scores(scattered(8.0)), second).verdict, Verdict::disagrees);
}

TEST(Judge, WhatAQuarterOfAnOctaveMakesOfAHighOrderIsProper) {
  const auto swings = [](double factor) {
    return scores(
        [=](double h) { return 1e4 * std::pow(h, 6.0) * synthetic::swing(h, factor, 1.0); },
        {.levels = 5});
  };
  const Claim sixth{Behaviour::proper, 6.0, {}};
  EXPECT_EQ(judge(swings(1.6), sixth).verdict, Verdict::agrees);
  EXPECT_EQ(judge(swings(2.0), sixth).verdict, Verdict::disagrees);
}

}  // namespace
}  // namespace clackers::judge
