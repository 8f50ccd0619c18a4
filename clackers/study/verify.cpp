#include "clackers/study/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
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
#include "clackers/study/method_candidate.hpp"
#include "clackers/study/shared_runs.hpp"
#include "clackers/study/solver_candidate.hpp"
#include "clackers/study/subject_study.hpp"
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

// The subjects of one case.
struct CaseStudy {
  const StudyCase* problem;
  record::RefinementPlan steps;
  std::vector<std::unique_ptr<SubjectStudy>> subjects;
};

struct Task {
  SubjectStudy* study;
  RunTask run;
};

// What a ladder lacks.
struct Round {
  SubjectStudy* study;
  record::RefinementPlan steps;
  std::vector<RunTask> missing;
  double seconds = 0.0;  // expected
};

// The studies of all cases: one scheduler, one budget.
class Driver {
 public:
  Driver(std::vector<CaseStudy>& cases, int threads, const Progress& progress,
         const std::atomic<bool>* interrupt)
      : threads_(threads), progress_(progress), interrupt_(interrupt) {
    for (auto& problem : cases)
      for (auto& study : problem.subjects) studies_.push_back(study.get());
  }

  // False when the refinement was interrupted.
  bool run(double budget) {
    std::vector<Round> rounds;
    for (auto* study : studies_)
      rounds.push_back({study, study->plan(), study->missing(study->plan())});
    run_rounds(rounds);
    for (const auto& round : rounds) round.study->assess(round.steps);
    if (budget > 0.0 && !is_interrupted() && !refine(budget)) return false;
    if (!is_interrupted()) explain();
    return true;
  }

 private:
  bool is_interrupted() const { return interrupt_ != nullptr && *interrupt_; }

  // In their order, but those of serial candidates one after another, by the first thread.
  void run_tasks(const std::vector<Task>& tasks) const {
    double cost = 0.0;
    std::vector<std::vector<const Task*>> queue;
    std::vector<const Task*> serial;
    for (const auto& task : tasks) {
      cost += task.study->cost(task.run);
      if (task.study->is_serial())
        serial.push_back(&task);
      else
        queue.push_back({&task});
    }
    if (!serial.empty()) queue.insert(queue.begin(), serial);
    ProgressMeter meter(cost, progress_);
    run_all(queue.size(), threads_, [&](std::size_t i) {
      for (const auto* task : queue[i]) {
        TaskShare share(meter, task->study->cost(task->run));
        task->study->make(task->run, share, interrupt_);
      }
    });
    if (!is_interrupted()) meter.finish();
  }

  // Case after case and subject after subject, so that an interrupt leaves whole rows.
  void run_rounds(const std::vector<Round>& rounds) const {
    std::vector<Task> tasks;
    for (const auto& round : rounds) {
      round.study->expect(round.missing);
      for (const auto& task : round.missing) tasks.push_back({round.study, task});
    }
    run_tasks(tasks);
  }

  // The next rounds of all open studies, those that end removed.
  std::vector<Round> next_rounds() const {
    std::vector<Round> rounds;
    for (auto* study : studies_) {
      if (study->is_closed()) continue;
      const auto next = study->next();
      if (!next.plan) {
        study->close(next.end);
        continue;
      }
      auto missing = study->missing(*next.plan);
      const double seconds = study->expected_seconds(missing, std::min(threads_, thread_count(0)));
      rounds.push_back({study, *next.plan, std::move(missing), seconds});
    }
    return rounds;
  }

  // Those that fit together into the time left, the shortest ones; what does not fit alone ends.
  static std::vector<Round> affordable(std::vector<Round> rounds, double left) {
    std::ranges::stable_sort(rounds, {}, &Round::seconds);
    double sum = 0.0;
    std::erase_if(rounds, [&](const Round& round) {
      if (!(round.seconds <= left))
        round.study->close(record::RefinementEnd::budget, round.seconds);
      sum += round.seconds;
      return !(sum <= left);
    });
    return rounds;
  }

  // False when interrupted: the last round is left out.
  bool refine(double budget) const {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    for (;;) {
      const double used = std::chrono::duration<double>(Clock::now() - start).count();
      const auto rounds = affordable(next_rounds(), budget - used);
      if (rounds.empty()) return true;
      run_rounds(rounds);
      if (is_interrupted()) {
        for (const auto& round : rounds) round.study->close(record::RefinementEnd::interrupted);
        return false;
      }
      for (const auto& round : rounds) round.study->assess(round.steps);
    }
  }

  // Causes of what the methods' runs show; one stored run a thread fills no memory.
  void explain() const {
    std::vector<Task> tasks;
    std::vector<SubjectStudy*> observed;
    for (auto* study : studies_) {
      const auto runs = study->to_observe();
      if (!runs.empty()) observed.push_back(study);
      for (const auto& run : runs) tasks.push_back({study, run});
    }
    if (tasks.empty()) return;
    run_tasks(tasks);
    run_all(observed.size(), threads_, [&](std::size_t i) { observed[i]->explain(); });
  }

  std::vector<SubjectStudy*> studies_;
  int threads_;
  const Progress& progress_;
  const std::atomic<bool>* interrupt_;
};

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
  const bool is_whole = Driver(cases, threads, progress, interrupt).run(request.budget);

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
