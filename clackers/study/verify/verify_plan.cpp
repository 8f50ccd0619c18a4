#include "clackers/study/verify/verify_plan.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/base/error.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/solvers/program.hpp"

namespace clackers::study {
namespace {

constexpr long long most_impact_times = 1000;

void require_steps(const record::RefinementPlan& plan, double end) {
  if (!(plan.coarsest > 0.0 && plan.coarsest <= end))
    refuse("verify", "coarsest", plan.coarsest,
           fmt::format("0 < coarsest <= {} s, the length of the run", end), {},
           "step-not-positive");
  if (plan.levels < 1)
    refuse("verify", "levels", fmt::format("{}", plan.levels), "a whole number, 1 or more",
           "A verdict needs at least four.");
  if (plan.samples_per_level < 1 || plan.samples_per_level > 64)
    refuse("verify", "neighbours", fmt::format("{}", plan.samples_per_level),
           "1 <= neighbours <= 64");
}

// The shortest period of the free masses: of the case where it has damped ones, else of the undamped
// modes of M and K.
double fast_period(const cases::Case& problem) {
  if (!problem.damped_periods.empty()) return *std::ranges::min_element(problem.damped_periods);
  const auto& system = problem.problem.system;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
      system.stiffness, system.mass, Eigen::EigenvaluesOnly);
  const double largest = modes.eigenvalues().maxCoeff();
  return largest > 0.0 ? 2.0 * std::numbers::pi / std::sqrt(largest) : problem.motion->end();
}

record::Quantity quantity(const cases::Constant& c) { return {c.name, c.value, c.unit, c.meaning}; }

// One refusal beside other methods is a row of the record; nothing but refusals is refused input.
void require_some_method(const std::vector<PlannedMethod>& all,
                         const model::ImpactProblem<>& problem) {
  const auto takes = [](const PlannedMethod& one) { return one.subject.refusal.empty(); };
  if (std::ranges::any_of(all, takes)) return;
  const auto objection = all.front().method->objection(problem);
  throw InputError(objection->sentence, objection->code);
}

CasePlan plan_of(const VerifyRequest& request, cases::Case problem) {
  auto plan = plan_without_methods(request.plan, request.tolerances, std::move(problem));
  for (const auto& specification :
       request.methods.empty() ? methods::default_panel() : request.methods) {
    auto method = planned_method(specification, plan);
    const auto same = [&](const PlannedMethod& one) {
      return one.subject.name == method.subject.name;
    };
    if (std::ranges::any_of(plan.methods, same))
      refuse("verify", "method", specification, "each method once",
             fmt::format("{} was named before.", method.subject.name), "bad-syntax");
    plan.methods.push_back(std::move(method));
  }
  require_some_method(plan.methods, plan.problem.problem);
  return plan;
}

}  // namespace

CasePlan plan_without_methods(const RefinementRequest& steps, std::vector<double> tolerances,
                              cases::Case problem) {
  CasePlan plan;
  plan.problem = std::move(problem);
  plan.summary = summary_of(plan.problem);
  plan.shared = measure::first_shared_instant(*plan.problem.motion, plan.problem.problem);
  plan.steps = plan_for(steps, plan.summary);
  require_steps(plan.steps, plan.summary.end);
  levels_of(plan, plan.steps);  // refuses too many steps before any work
  plan.tolerances = tolerances.empty() ? solvers::tolerances_from(solvers::default_tolerances)
                                       : std::move(tolerances);
  return plan;
}

PlannedMethod planned_method(const std::string& specification, const CasePlan& plan) {
  const auto& problem = plan.problem.problem;
  const bool collides = plan.summary.impact_count > 0;
  PlannedMethod planned;
  planned.method = methods::method(specification);
  const auto facts = planned.method->facts();
  planned.reports_impacts = facts.reports_impacts;
  planned.order = facts.smooth_order;
  auto& subject = planned.subject;
  subject.name = short_name(facts.name);
  subject.claim = methods::claim_on(facts, problem, collides, plan.shared.has_value());
  if (facts.is_adaptive) {
    subject.resolution = record::Resolution::tolerance;
    // The estimate falls with the power of the step that the error over a run does.
    if (subject.claim.order > 0.0) subject.claim.order = 1.0;
  }
  if (const auto objection = planned.method->objection(problem)) {
    subject.refusal = objection->sentence;
    subject.refusal_code = objection->code.name();
  } else if (collides) {
    subject.contact_time = planned.method->contact_time(problem);
    constexpr double of_linear_spring = 0.5;
    if (facts.model_order == of_linear_spring) planned.spring_time = subject.contact_time;
  }
  return planned;
}

std::string short_name(const std::string& name) {
  constexpr std::string_view understood = "+event-driven";
  return name.ends_with(understood) ? name.substr(0, name.size() - understood.size()) : name;
}

record::CaseSummary summary_of(const cases::Case& problem) {
  record::CaseSummary summary;
  summary.name = problem.entry->name;
  summary.summary = problem.entry->summary;
  summary.equations = problem.entry->equations;
  for (std::size_t i = 0; i < problem.values.size(); ++i) {
    const auto& parameter = problem.entry->parameters[i];
    const auto& value = problem.values[i].second;
    auto& added = summary.parameters.emplace_back(
        record::Quantity{parameter.name, NAN, parameter.unit, parameter.meaning});
    if (value.is_word())
      added.text = value.text();
    else
      added.value = value;
  }
  for (const auto& c : problem.constants) summary.constants.push_back(quantity(c));
  for (const auto& c : problem.indicators) summary.constants.push_back(quantity(c));
  summary.end = problem.motion->end();
  summary.fast_period = fast_period(problem);
  summary.impact_count = problem.motion->impact_count(summary.end);
  for (long long k = 1; k <= std::min(summary.impact_count, most_impact_times); ++k) {
    const auto impact = problem.motion->impact(k);
    summary.impact_times.push_back(impact.t);
    summary.impact_contacts.push_back(impact.contact);
  }
  summary.drawing = record::schematic(problem.problem);
  return summary;
}

std::vector<judge::StepLevel> levels_of(const CasePlan& plan, const record::RefinementPlan& steps) {
  return judge::step_ladder({steps.coarsest, steps.levels, steps.samples_per_level},
                            plan.summary.end, plan.summary.impact_times);
}

std::vector<judge::StepLevel> levels_of(const CasePlan& plan, const PlannedMethod& method,
                                        const record::RefinementPlan& steps) {
  if (method.subject.resolution == record::Resolution::step) return levels_of(plan, steps);
  std::vector<judge::StepLevel> levels;
  long long count = 0;
  for (const double tolerance : plan.tolerances) {
    const double per_period = 2.5 * std::pow(tolerance, -1.0 / method.order);
    count =
        std::max(count + 1, std::llround(per_period * plan.summary.end / plan.summary.fast_period));
    levels.push_back({tolerance, {count}, {tolerance}});
  }
  return levels;
}

bool has_adaptive_method(const VerifyRequest& request) {
  return std::ranges::any_of(request.methods, [](const std::string& specification) {
    return methods::method(specification)->facts().is_adaptive;
  });
}

std::vector<cases::Case> cases_of(const VerifyRequest& request) {
  auto names = request.cases;
  if (names.empty()) names.emplace_back(cases::default_case());
  std::vector<cases::Case> all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::ranges::count(names, names[i]) > 1)
      refuse("verify", "case", names[i], "each case once", {}, "bad-syntax");
    all.push_back(cases::make(
        names[i], request.case_settings.empty() ? request.settings : request.case_settings.at(i)));
  }
  return all;
}

std::vector<CasePlan> plans_of(const VerifyRequest& request) {
  std::vector<CasePlan> plans;
  for (auto& problem : cases_of(request)) plans.push_back(plan_of(request, std::move(problem)));
  return plans;
}

}  // namespace clackers::study
