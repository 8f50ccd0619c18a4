#include "clackers/study/refinement.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/base/codes.hpp"
#include "clackers/base/number.hpp"
#include "clackers/judge/convergence/fit/error_ladder.hpp"
#include "clackers/judge/convergence/judge.hpp"
#include "clackers/judge/convergence/ladder_fit.hpp"
#include "clackers/judge/convergence/step_ladder.hpp"

namespace clackers::study {
namespace {

constexpr int most_default_levels = 8, least_default_levels = 5;
constexpr double most_default_steps = 1 << 20;
constexpr double least_steps_per_period = 2.0;

double nominal_step(const record::RefinementPlan& plan, int level) {
  return std::ldexp(plan.coarsest, -level);
}

bool has_weak_envelope(const record::Subject& subject) {
  const auto& fit = subject.assessment.displacement;
  return fit.has_line && fit.on_envelope &&
         fit.spread > judge::envelope_order_tolerance * subject.claim.order;
}

bool is_decided(const record::Subject& subject) {
  const auto verdict = subject.assessment.verdict;
  return verdict != Verdict::undecided &&
         !(verdict == Verdict::agrees && has_weak_envelope(subject));
}

bool is_at_floor(const measure::ScoreLevel& level) {
  return std::ranges::all_of(level.runs, [](const measure::RunScore& run) {
    return run.u_error <= judge::rounding_slack * run.rounding_floor;
  });
}

// Finer levels up to the first one that resolves the contact, then one by one to as many as are
// wanted: the last ones cost most.
int next_contact_levels(const record::Subject& subject, const record::RefinementPlan& plan) {
  if (!(subject.contact_time > 0.0)) return 0;
  const double resolving = subject.contact_time / judge::steps_per_contact;
  const int first = std::max(0, int(std::ceil(std::log2(plan.coarsest / resolving))));
  if (plan.levels >= first + wanted_contact_levels) return 0;
  return std::max(1, first + 1 - plan.levels);
}

NextPlan with_finer(record::RefinementPlan plan, int more, double end) {
  plan.levels += more;
  if (!(end / nominal_step(plan, plan.levels) <= judge::most_steps))
    return {{}, record::RefinementEnd::too_many_steps};
  return {plan};
}

}  // namespace

double default_coarsest(double fast_period, double end) {
  return std::min(rounded(fast_period / default_steps_per_period, 2), end);
}

int default_levels(double coarsest, double end) {
  if (!(coarsest > 0.0) || !std::isfinite(coarsest)) return least_default_levels;
  const double halvings = std::floor(std::log2(most_default_steps * coarsest / end));
  return int(std::clamp<double>(1.0 + halvings, least_default_levels, most_default_levels));
}

record::RefinementPlan plan_for(const RefinementRequest& request,
                                const record::CaseSummary& problem, LadderKind kind) {
  const bool of_solvers = kind == LadderKind::solvers;
  const double coarsest =
      request.coarsest.value_or(default_coarsest(problem.fast_period, problem.end));
  const int levels = of_solvers ? default_solver_levels : default_levels(coarsest, problem.end);
  const int samples = of_solvers ? default_solver_samples_per_level : default_samples_per_level;
  return {coarsest, request.levels.value_or(levels), request.samples_per_level.value_or(samples)};
}

std::optional<record::Refinement> refinement_of(const record::RefinementPlan& asked,
                                                const record::RefinementPlan& now,
                                                record::RefinementEnd end, double next_seconds) {
  const int coarser = int(std::lround(std::log2(now.coarsest / asked.coarsest)));
  const record::Refinement found{now.levels - asked.levels - coarser, coarser,
                                 now.samples_per_level, end, next_seconds};
  const bool is_asked = found.finer_levels == 0 && found.coarser_levels == 0 &&
                        found.samples_per_level == asked.samples_per_level;
  if (end == record::RefinementEnd::decided && is_asked) return {};
  return found;
}

NextPlan next_plan(const record::Subject& subject, const measure::Ladder& ladder,
                   const record::RefinementPlan& plan, const record::CaseSummary& problem) {
  if (!subject.refusal.empty() || !subject.complete || ladder.empty()) return {};
  if (const int missing = next_contact_levels(subject, plan);
      missing > 0 && subject.assessment.verdict != Verdict::agrees)
    return with_finer(plan, missing, problem.end);
  if (is_decided(subject)) return {};
  const auto& finest = ladder.back();
  if (!std::ranges::all_of(finest.runs, &measure::RunScore::finished))
    return {{}, record::RefinementEnd::run_failed};
  if (has_weak_envelope(subject) && subject.assessment.reason != Code("too-few-levels").name() &&
      2 * plan.samples_per_level <= most_samples_per_level)
    return {record::RefinementPlan{plan.coarsest, plan.levels, 2 * plan.samples_per_level}};
  if (!is_at_floor(finest)) return with_finer(plan, 1, problem.end);
  const double coarser = 2.0 * plan.coarsest;
  if (coarser > std::min(problem.end, problem.fast_period / least_steps_per_period))
    return {{}, record::RefinementEnd::rounding_floor};
  return {record::RefinementPlan{coarser, plan.levels + 1, plan.samples_per_level}};
}

}  // namespace clackers::study
