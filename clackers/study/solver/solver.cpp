#include "clackers/study/solver.hpp"

#include <algorithm>
#include <chrono>
#include <deque>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/jobs/work_queue.hpp"
#include "clackers/record/provenance.hpp"
#include "clackers/record/reduced_curve.hpp"
#include "clackers/study/solver/solver_study.hpp"
#include "clackers/study/verify/verify_plan.hpp"
#include "clackers/tables/respond.hpp"

namespace clackers::study {
namespace {

// A start costs a solver about as much as this many steps.
constexpr double start_steps = 5000.0;

// Studies of one case; a deque, since they do not move.
using CaseStudies = std::deque<SolverStudy>;

struct Task {
  SolverStudy* study;
  SolverRun run;
  double cost() const { return start_steps + double(run.steps); }
};

// A record of the cases, without subjects.
record::Record empty_record(const VerifyRequest& request, const std::vector<cases::Case>& problems,
                            bool has_plan) {
  record::Record record;
  record.provenance = record::provenance(request.command);
  for (const auto& problem : problems) {
    record::CaseRecord one;
    one.problem = summary_of(problem);
    one.plan = has_plan ? plan_for(request.plan, one.problem) : no_refinement;
    one.response = reduced(tables::response_curve(problem, tables::response_points));
    record.cases.push_back(std::move(one));
  }
  return record;
}

// Each name once, over methods and solvers.
void require_names(const VerifyRequest& request, const std::vector<SolverSubject>& solvers) {
  std::vector<std::string> names = request.methods;
  for (const auto& solver : solvers) {
    if (std::ranges::find(names, solver.name) != names.end())
      refuse("verify", "name of a solver", solver.name, "each name once",
             "Give every program a --name, every callable a name.", "bad-syntax");
    names.push_back(solver.name);
  }
}

void require_levels(const SolverSubject& solver) {
  const auto require = [&](const char* what, const std::vector<double>& values) {
    for (const double value : values) require_step("verify", value);
    if (std::ranges::adjacent_find(values, std::less_equal{}) != values.end())
      refuse("verify", what, values.front(), "descending values, each once", {}, "not-sorted");
  };
  require("steps", solver.steps);
  require("tolerances", solver.tolerances);
}

class SolverStudies {
 public:
  SolverStudies(const VerifyRequest& request, const std::vector<cases::Case>& problems,
                const std::vector<SolverSubject>& solvers, record::Record& record,
                const std::atomic<bool>* interrupt)
      : request_(request),
        record_(record),
        interrupt_(interrupt),
        threads_(thread_count(request.jobs)) {
    for (std::size_t i = 0; i < problems.size(); ++i) {
      const auto& one = record.cases[i];
      auto& studies = cases_.emplace_back();
      for (const auto& solver : solvers)
        studies.emplace_back(solver, problems[i], one.problem, plan_for(request.plan, one.problem),
                             interrupt);
    }
  }

  void run(const Progress& progress) {
    std::vector<Task> tasks;
    for (auto& studies : cases_)
      for (auto& study : studies)
        for (const auto& run : study.missing(study.plan())) tasks.push_back({&study, run});
    make(tasks, progress);
    for (auto& studies : cases_)
      for (auto& study : studies) study.assess(study.plan());
    if (request_.budget > 0.0)
      for (auto& studies : cases_)
        for (auto& study : studies) refine(study, progress);
    for (std::size_t c = 0; c < cases_.size(); ++c)
      for (auto& study : cases_[c]) {
        record_.cases[c].subjects.push_back(study.finish());
        record_.interrupted = record_.interrupted || is_interrupted();
      }
  }

 private:
  bool is_interrupted() const { return interrupt_ != nullptr && *interrupt_; }

  void make(const std::vector<Task>& tasks, const Progress& progress) const {
    double cost = 0.0;
    for (const auto& task : tasks) cost += task.cost();
    ProgressMeter meter(cost, progress);
    run_all(tasks.size(), threads_, [&](std::size_t i) {
      const TaskShare share(meter, tasks[i].cost());
      tasks[i].study->make(tasks[i].run);
    });
    if (!is_interrupted()) meter.finish();
  }

  // One solver after the other, each while it is open and the time lasts.
  void refine(SolverStudy& study, const Progress& progress) {
    using Clock = std::chrono::steady_clock;
    for (;;) {
      if (is_interrupted()) return study.close(record::RefinementEnd::interrupted);
      const auto next = study.next();
      if (!next.plan) return study.close(next.end);
      const auto runs = study.missing(*next.plan);
      // Callables are called in one thread.
      const bool is_serial = study.kind() == record::SubjectKind::callable;
      const int parallel = is_serial ? 1 : std::min(threads_, thread_count(0));
      const double expected = study.expected_seconds(runs) / parallel;
      if (!(used_ + expected <= request_.budget))
        return study.close(record::RefinementEnd::budget, expected);
      const auto start = Clock::now();
      std::vector<Task> tasks;
      for (const auto& run : runs) tasks.push_back({&study, run});
      make(tasks, progress);
      study.assess(*next.plan);
      used_ += std::chrono::duration<double>(Clock::now() - start).count();
    }
  }

  const VerifyRequest& request_;
  record::Record& record_;
  const std::atomic<bool>* interrupt_;
  int threads_;
  std::deque<CaseStudies> cases_;
  double used_ = 0.0;  // of the budget [s]
};

}  // namespace

record::Record verify(const VerifyRequest& request, std::vector<SolverSubject> solvers,
                      const Progress& progress, const std::atomic<bool>* interrupt) {
  require_names(request, solvers);
  for (const auto& solver : solvers) require_levels(solver);
  const bool has_plan =
      !request.methods.empty() || std::ranges::any_of(solvers, [](const SolverSubject& one) {
        return one.tolerances.empty() && one.steps.empty();
      });
  const auto problems = cases_of(request);
  auto record = empty_record(request, problems, has_plan);
  SolverStudies studies(request, problems, solvers, record, interrupt);
  // Tolerances may be for the solvers alone.
  auto of_methods = request;
  if (!has_adaptive_method(request)) of_methods.tolerances.clear();
  // Progress of either comes in rounds of its own.
  if (!request.methods.empty()) record = verify(of_methods, progress, interrupt);
  studies.run(progress);
  return record;
}

const record::Run* failure_of_all(const record::Record& record) {
  const record::Run* first = nullptr;
  for (const auto& one : record.cases)
    for (const auto& subject : one.subjects)
      for (const auto& level : subject.levels)
        for (const auto& run : level.runs) {
          if (run.score.finished) return nullptr;
          if (first == nullptr && is_solver(subject.kind)) first = &run;
        }
  return first;
}

}  // namespace clackers::study
