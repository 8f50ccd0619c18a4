#include "clackers/study/verify_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/methods/registry.hpp"

namespace clackers::study {
namespace {

constexpr long long most_impact_times = 1000;

void require_ladder(const LadderPlan& plan, double end) {
  if (!(plan.coarsest > 0.0 && plan.coarsest <= end))
    refuse("verify", "coarsest", plan.coarsest,
           fmt::format("0 < coarsest <= {} s, the length of the run", end), {},
           "step-not-positive");
  if (plan.levels < 1)
    refuse("verify", "levels", fmt::format("{}", plan.levels), "a whole number, 1 or more",
           "A verdict needs at least four.");
  if (plan.neighbours < 1 || plan.neighbours > 64)
    refuse("verify", "neighbours", fmt::format("{}", plan.neighbours), "1 <= neighbours <= 64");
}

Quantity quantity(const cases::Constant& c) { return {c.name, c.value, c.unit, c.meaning}; }

// While nothing collides a method is held to its smooth order, not to what it does at impacts.
Claim claim_of(const methods::Facts& facts, bool collides) {
  if (collides) return facts.through_impacts;
  return {Behaviour::proper, facts.smooth_order, {}};
}

PlannedMethod planned(const std::string& specification, const model::ImpactProblem<>& problem,
                      bool collides) {
  PlannedMethod planned;
  planned.method = methods::method(specification);
  const auto facts = planned.method->facts();
  planned.reports_impacts = facts.reports_impacts;
  planned.result.name = facts.name;
  planned.result.claim = claim_of(facts, collides);
  if (const auto objection = planned.method->objection(problem)) {
    planned.result.refusal = objection->sentence;
    planned.result.refusal_code = objection->code.name();
  } else if (collides) {
    planned.result.contact_time = planned.method->contact_time(problem);
  }
  return planned;
}

// One refusal beside other methods is a row of the record; nothing but refusals is refused input.
void require_some_method(const std::vector<PlannedMethod>& all,
                         const model::ImpactProblem<>& problem) {
  const auto takes = [](const PlannedMethod& one) { return one.result.refusal.empty(); };
  if (std::ranges::any_of(all, takes)) return;
  const auto objection = all.front().method->objection(problem);
  throw InputError(objection->sentence, objection->code);
}

}  // namespace

CaseSummary summary_of(const cases::Case& which) {
  CaseSummary summary;
  summary.name = which.entry->name;
  summary.summary = which.entry->summary;
  summary.equations = which.entry->equations;
  for (std::size_t i = 0; i < which.values.size(); ++i) {
    const auto& parameter = which.entry->parameters[i];
    summary.parameters.push_back(
        {parameter.name, which.values[i].second, parameter.unit, parameter.meaning});
  }
  for (const auto& c : which.constants) summary.constants.push_back(quantity(c));
  for (const auto& c : which.indicators) summary.constants.push_back(quantity(c));
  summary.end = which.motion->end();
  summary.fast_period = *std::ranges::min_element(which.damped_periods);
  summary.impact_count = which.motion->impact_count(summary.end);
  for (long long k = 1; k <= std::min(summary.impact_count, most_impact_times); ++k)
    summary.impact_times.push_back(which.motion->impact(k).t);
  return summary;
}

VerifyPlan plan_of(const VerifyRequest& request) {
  VerifyPlan plan;
  plan.problem = cases::make(request.case_name.empty() ? cases::default_case() : request.case_name,
                             request.settings);
  plan.summary = summary_of(plan.problem);
  require_ladder(request.plan, plan.summary.end);
  for (const auto& specification :
       request.methods.empty() ? methods::default_panel() : request.methods) {
    plan.methods.push_back(
        planned(specification, plan.problem.problem, plan.summary.impact_count > 0));
    const auto& name = plan.methods.back().result.name;
    if (std::ranges::count(plan.methods, name, [](const auto& one) { return one.result.name; }) > 1)
      refuse("verify", "method", specification, "each method once",
             fmt::format("{} was named before.", name), "bad-syntax");
  }
  require_some_method(plan.methods, plan.problem.problem);
  plan.ladder =
      assess::step_ladder({request.plan.coarsest, request.plan.levels, request.plan.neighbours},
                          plan.summary.end, plan.summary.impact_times);
  return plan;
}

}  // namespace clackers::study
