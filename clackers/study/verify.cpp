#include "clackers/study/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/jobs/work_queue.hpp"
#include "clackers/judge/convergence/step_ladder.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/record/record.hpp"
#include "clackers/record/reduced_curve.hpp"
#include "clackers/solvers/program.hpp"
#include "clackers/study/driver.hpp"
#include "clackers/study/method_candidate.hpp"
#include "clackers/study/shared_runs.hpp"
#include "clackers/study/solver_candidate.hpp"
#include "clackers/tables/case_summary.hpp"
#include "clackers/tables/respond.hpp"

namespace clackers::study {
namespace {

using Methods = std::vector<std::shared_ptr<const methods::Method>>;

Methods methods_of(const VerifyRequest& request) {
  Methods all;
  const bool has_panel = request.methods.empty() && request.solvers.empty();
  for (const auto& specification : has_panel ? methods::default_panel() : request.methods)
    all.push_back(methods::method(specification));
  return all;
}

LadderKind kind_of(const VerifyRequest& request) {
  return request.solvers.empty() ? LadderKind::methods : LadderKind::solvers;
}

// Whether some subject takes the steps of the plan.
bool has_plan(const VerifyRequest& request) {
  return request.solvers.empty() || !request.methods.empty() ||
         std::ranges::any_of(request.solvers, [](const solvers::SolverSubject& solver) {
           return solver.tolerances.empty() && solver.steps.empty();
         });
}

// Each name once, over methods and solvers.
void require_names(const VerifyRequest& request, const Methods& methods) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const auto name = methods::short_name(methods[i]->facts().name);
    if (std::ranges::find(names, name) != names.end())
      refuse("verify", "method", request.methods.empty() ? name : request.methods[i],
             "each method once", fmt::format("{} has appeared before.", name), "bad-syntax");
    names.push_back(name);
  }
  names.insert(names.end(), request.methods.begin(), request.methods.end());
  for (const auto& solver : request.solvers) {
    if (std::ranges::find(names, solver.name) != names.end())
      refuse("verify", "name of a solver", solver.name, "each name once",
             "Give every program a --name, every callable a name.", "bad-syntax");
    names.push_back(solver.name);
  }
}

void require_levels(const solvers::SolverSubject& solver) {
  const auto require = [&](const char* what, const std::vector<double>& values) {
    for (const double value : values) require_step("verify", value);
    if (std::ranges::adjacent_find(values, std::less_equal{}) != values.end())
      refuse("verify", what, values.front(), "descending values, each once", {}, "not-sorted");
  };
  require("steps", solver.steps);
  require("tolerances", solver.tolerances);
}

// One refusal beside other methods is a row of the record; nothing but refusals is refused input.
void require_some_method(const Methods& methods, const model::ImpactProblem<>& problem) {
  if (methods.empty()) return;
  const auto refuses = [&](const auto& method) { return method->objection(problem).has_value(); };
  if (!std::ranges::all_of(methods, refuses)) return;
  const auto objection = methods.front()->objection(problem);
  throw InputError(objection->sentence, objection->code);
}

void require_valid(const VerifyRequest& request, const Methods& methods) {
  if (!(request.budget >= 0.0 && std::isfinite(request.budget)))
    refuse("verify", "budget", request.budget, "0 s or more", "0 refines nothing beyond the plan.");
  const auto is_adaptive = [](const auto& method) { return method->facts().is_adaptive; };
  if (!request.plan.tolerances.empty() && request.solvers.empty() &&
      std::ranges::none_of(methods, is_adaptive))
    refuse("verify", "tolerances", request.plan.tolerances.front(),
           "those of a method that is adaptive, such as dopri5", {}, "wrong-resolution");
  require_names(request, methods);
  for (const auto& solver : request.solvers) require_levels(solver);
}

std::vector<StudyCase> cases_of(const VerifyRequest& request) {
  auto names = request.cases;
  if (names.empty()) names.emplace_back(cases::default_case());
  std::vector<StudyCase> all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::ranges::count(names, names[i]) > 1)
      refuse("verify", "case", names[i], "each case once", {}, "bad-syntax");
    all.push_back(study_case(cases::make(
        names[i], request.case_settings.empty() ? request.settings : request.case_settings.at(i))));
  }
  return all;
}

CaseStudy case_study(const VerifyRequest& request, const Methods& methods,
                     const StudyCase& problem) {
  require_some_method(methods, problem.problem.problem);
  CaseStudy study{&problem, checked_plan(request.plan, problem, kind_of(request)), {}};
  const auto tolerances = tolerances_of(request.plan);
  for (const auto& method : methods)
    study.subjects.push_back(std::make_unique<SubjectStudy>(
        problem, std::make_unique<MethodCandidate>(method, problem, tolerances, Extras{}),
        study.steps, Wanted{.history_bins = history_bins, .metrics = true}));
  return study;
}

// With the methods, whose profiles compare their work; that of solvers is not known.
record::CaseRecord case_record(const VerifyRequest& request, CaseStudy& study) {
  record::CaseRecord record;
  record.problem = study.problem->summary;
  record.plan = has_plan(request) ? study.steps : no_refinement;
  record.response = tables::response_curve(study.problem->problem, tables::response_points);
  for (auto& subject : study.subjects)
    if (!is_solver(subject->subject().kind)) record.subjects.push_back(subject->finish());
  record.profiles = record::profiles_of({&record, 1});
  if (record.subjects.empty()) record.response = reduced(record.response);
  return record;
}

}  // namespace

StudyCase study_case(cases::Case problem) {
  auto summary = tables::summary_of(problem);
  auto shared = measure::shared_instants(*problem.motion, problem.problem);
  const double closest = measure::closest_impacts(*problem.motion, problem.problem);
  auto states = std::make_shared<measure::SharedStates>(problem.motion, problem.problem.start.t);
  auto scales =
      std::make_shared<const measure::Scales>(measure::scales_of(*problem.motion, problem.problem));
  return {std::move(problem),
          std::move(summary),
          std::move(shared),
          closest,
          std::move(states),
          std::move(scales),
          std::make_shared<SharedRuns>()};
}

record::RefinementPlan checked_plan(const RefinementRequest& request, const StudyCase& problem,
                                    LadderKind kind) {
  const auto plan = plan_for(request, problem.summary, kind);
  const double end = problem.summary.end;
  if (!(plan.coarsest > 0.0 && plan.coarsest <= end))
    refuse("verify", "coarsest", plan.coarsest,
           fmt::format("0 < coarsest <= {} s, the length of the run", end), {},
           "step-not-positive");
  if (plan.levels < 1)
    refuse("verify", "levels", fmt::format("{}", plan.levels), "a whole number, 1 or more",
           "A verdict needs at least four.");
  if (plan.samples_per_level < 1 || plan.samples_per_level > 64)
    refuse("verify", "samples per level", fmt::format("{}", plan.samples_per_level),
           "1 <= samples per level <= 64");
  // Refuses too many steps before any work.
  judge::step_ladder(plan, end, problem.summary.impact_times);
  return plan;
}

std::vector<double> tolerances_of(const RefinementRequest& request) {
  return request.tolerances.empty() ? solvers::tolerances_from(solvers::default_tolerances)
                                    : request.tolerances;
}

std::vector<PlannedCase> planned_cases(const VerifyRequest& request) {
  const auto methods = methods_of(request);
  require_valid(request, methods);
  std::vector<PlannedCase> all;
  for (const auto& problem : cases_of(request)) {
    const auto study = case_study(request, methods, problem);
    all.push_back({problem.summary, has_plan(request) ? study.steps : no_refinement});
  }
  return all;
}

record::Record verify(const VerifyRequest& request, const Progress& progress,
                      const std::atomic<bool>* interrupt) {
  const int threads = thread_count(request.jobs);
  const auto methods = methods_of(request);
  require_valid(request, methods);
  const auto problems = cases_of(request);
  std::vector<CaseStudy> cases;
  for (const auto& problem : problems) cases.push_back(case_study(request, methods, problem));
  for (auto& study : cases)
    for (const auto& solver : request.solvers)
      study.subjects.push_back(std::make_unique<SubjectStudy>(
          *study.problem, std::make_unique<SolverCandidate>(solver, *study.problem), study.steps));
  const bool is_whole = run_studies(cases, request.budget, threads, progress, interrupt);

  record::Record record;
  record.command = "verify";
  record.provenance = record::provenance(request.command);
  for (auto& study : cases) record.cases.push_back(case_record(request, study));
  if (record.cases.size() > 1) record.profiles = profiles_of(record.cases);
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (auto& study : cases[i].subjects)
      if (is_solver(study->subject().kind)) record.cases[i].subjects.push_back(study->finish());
  record.interrupted = counts(record).interrupted > 0 || !is_whole;
  return record;
}

}  // namespace clackers::study
