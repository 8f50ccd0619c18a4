#include "clackers/study/refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clackers::study {
namespace {

constexpr double end = 20.0;

record::CaseSummary problem() {
  record::CaseSummary summary;
  summary.end = end;
  summary.fast_period = 0.7;
  return summary;
}

// A subject on `plan` with a run a level, error h^2 far above rounding.
record::Subject undecided(const record::RefinementPlan& plan, double floor = 1e-30) {
  record::Subject subject;
  for (int i = 0; i < plan.levels; ++i) {
    record::Run run;
    run.score.step = std::ldexp(plan.coarsest, -i);
    run.score.finished = true;
    run.score.u_error = run.score.step * run.score.step;
    run.score.rounding_floor = floor;
    subject.levels.push_back({run.score.step, {run}});
  }
  subject.claim = {Behaviour::proper, 2.0, {}};
  subject.assessment.verdict = Verdict::undecided;
  return subject;
}

record::Subject with_envelope(const record::RefinementPlan& plan, double spread) {
  auto subject = undecided(plan);
  subject.claim = {Behaviour::irregular, 1.0, {}};
  auto& fit = subject.assessment.displacement;
  fit.has_line = fit.on_envelope = true;
  fit.order = 1.1;
  fit.spread = spread;
  return subject;
}

struct Steps {
  double coarsest;
  int levels, samples;
  bool operator==(const Steps&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Steps& x) {
  return out << x.coarsest << " s, " << x.levels << " levels of " << x.samples;
}

NextPlan of(const record::Subject& subject, const record::RefinementPlan& plan) {
  return next_plan(subject, ladder_of(subject), plan, problem());
}

Steps next(const record::Subject& subject, const record::RefinementPlan& plan) {
  const auto found = of(subject, plan);
  if (!found.plan) return {};
  return {found.plan->coarsest, found.plan->levels, found.plan->samples_per_level};
}

TEST(DefaultCoarsest, IsAFourteenthOfTheFastPeriodInTwoDigits) {
  // 2 pi / ((4 N + 1) sqrt(1 - 0.05^2)) / 14, by hand.
  EXPECT_EQ(default_coarsest(0.69900, end), 0.05);
  EXPECT_EQ(default_coarsest(6.29105, end), 0.45);
  EXPECT_EQ(default_coarsest(0.29957, end), 0.021);
  EXPECT_EQ(default_coarsest(0.077668, end), 0.0055);
  EXPECT_EQ(default_coarsest(0.015688, end), 0.0011);
}

TEST(DefaultCoarsest, IsNotBeyondTheEnd) { EXPECT_EQ(default_coarsest(6.3, 0.3), 0.3); }

TEST(DefaultLevels, AreEightUnlessTheFinestWouldBeLong) {
  EXPECT_EQ(default_levels(0.05, end), 8);
  EXPECT_EQ(default_levels(end / 8192.0, end), 8);  // 8192 * 2^7 = 2^20
  EXPECT_EQ(default_levels(end / 8193.0, end), 7);
  EXPECT_EQ(default_levels(1e-9, end), 5);
  EXPECT_EQ(default_levels(end, end), 8);
}

TEST(PlanFor, TakesWhatIsAskedFor) {
  const auto plan = plan_for({.coarsest = 0.3, .levels = 3, .samples_per_level = 5}, problem());
  EXPECT_EQ(plan.coarsest, 0.3);
  EXPECT_EQ(plan.levels, 3);
  EXPECT_EQ(plan.samples_per_level, 5);
  const auto standard = plan_for({}, problem());
  EXPECT_EQ(standard.coarsest, 0.05);
  EXPECT_EQ(standard.levels, 8);
  EXPECT_EQ(standard.samples_per_level, 8);
}

TEST(NextPlan, IsNoneForWhatIsDecidedRefusedOrIncomplete) {
  const record::RefinementPlan plan{0.05, 4, 8};
  for (const auto verdict : {Verdict::agrees, Verdict::disagrees, Verdict::not_claimed}) {
    auto subject = undecided(plan);
    subject.assessment.verdict = verdict;
    EXPECT_EQ(next(subject, plan), Steps{});
  }
  auto refused = undecided(plan);
  refused.refusal = "no";
  EXPECT_EQ(next(refused, plan), Steps{});
  auto incomplete = undecided(plan);
  incomplete.complete = false;
  EXPECT_EQ(next(incomplete, plan), Steps{});
}

TEST(NextPlan, AddsAFinerLevel) {
  EXPECT_EQ(next(undecided({0.05, 4, 8}), {0.05, 4, 8}), (Steps{0.05, 5, 8}));
}

TEST(NextPlan, AddsTheLevelsThatACompliantContactNeeds) {
  // 25 steps a contact of 0.025 s: 0.001 s. 0.05 / 2^6 = 7.8e-4 is the seventh level; three of them.
  const record::RefinementPlan plan{0.05, 4, 8};
  auto subject = undecided(plan);
  subject.contact_time = 0.025;
  EXPECT_EQ(next(subject, plan), (Steps{0.05, 7, 8}));
  EXPECT_EQ(next(subject, {0.05, 7, 8}), (Steps{0.05, 8, 8}));
  subject.assessment.verdict = Verdict::disagrees;
  EXPECT_EQ(next(subject, plan), (Steps{0.05, 7, 8})) << "impacts are not counted yet";
  subject.assessment.verdict = Verdict::agrees;
  EXPECT_EQ(next(subject, plan), Steps{});
  auto resolved = undecided({0.05, 9, 8});
  resolved.contact_time = 0.025;
  EXPECT_EQ(next(resolved, {0.05, 9, 8}), (Steps{0.05, 10, 8}));
  resolved.assessment.verdict = Verdict::disagrees;
  EXPECT_EQ(next(resolved, {0.05, 9, 8}), Steps{});
}

TEST(NextPlan, TakesMoreStepsALevelWhereTheEnvelopeIsUncertain) {
  const record::RefinementPlan plan{0.05, 8, 8};
  auto weak = with_envelope(plan, 0.3);
  EXPECT_EQ(next(weak, plan), (Steps{0.05, 8, 16}));
  weak.assessment.verdict = Verdict::agrees;
  EXPECT_EQ(next(weak, plan), (Steps{0.05, 8, 16})) << "weak evidence";
  EXPECT_EQ(next(weak, {0.05, 8, 32}), (Steps{0.05, 9, 32}));
  weak.assessment.reason = "too-few-levels";
  EXPECT_EQ(next(weak, plan), (Steps{0.05, 9, 8})) << "large errors";
  auto sure = with_envelope(plan, 0.2);
  EXPECT_EQ(next(sure, plan), (Steps{0.05, 9, 8}));
  sure.assessment.verdict = Verdict::agrees;
  EXPECT_EQ(next(sure, plan), Steps{});
}

TEST(NextPlan, StartsCoarserAtTheRoundingFloor) {
  const record::RefinementPlan plan{0.05, 4, 8};
  EXPECT_EQ(next(undecided(plan, 1.0), plan), (Steps{0.1, 5, 8}));
  // Two steps a period of 0.7 s: no coarser than 0.35 s.
  const record::RefinementPlan coarse{0.2, 6, 8};
  const auto found = of(undecided(coarse, 1.0), coarse);
  EXPECT_FALSE(found.plan);
  EXPECT_EQ(found.end, record::RefinementEnd::rounding_floor);
}

TEST(NextPlan, EndsAtFailedRunsAndAtTheMostSteps) {
  const record::RefinementPlan plan{0.05, 4, 8};
  auto failed = undecided(plan);
  failed.levels.back().runs[0].score.finished = false;
  EXPECT_EQ(of(failed, plan).end, record::RefinementEnd::run_failed);
  // 20 s / 2e-8 s is the limit of 1e9 steps; the next level has a finest step of nearly half its
  // nominal one.
  const record::RefinementPlan long_one{1.5e-7, 2, 8};
  const auto found = of(undecided(long_one), long_one);
  EXPECT_FALSE(found.plan);
  EXPECT_EQ(found.end, record::RefinementEnd::too_many_steps);
}

}  // namespace
}  // namespace clackers::study
