#include "clackers/study/system_study.hpp"

#include <utility>

#include "clackers/methods/registry.hpp"
#include "clackers/study/solver/solver_study.hpp"
#include "clackers/study/verify/method_study.hpp"
#include "clackers/study/verify/verify_plan.hpp"

namespace clackers::study {

struct SystemStudy::Plan : CasePlan {};

SystemStudy::SystemStudy(const SystemRequest& request, cases::Case problem)
    : plan_(std::make_unique<Plan>(
          Plan{plan_without_methods(request.plan, request.tolerances, std::move(problem))})) {
  plan_->extras = {.record = false, .metrics = request.metrics, .times = request.times};
  record_.problem = plan_->summary;
  record_.plan = plan_->steps;
}

SystemStudy::~SystemStudy() = default;

const record::CaseRecord* SystemStudy::assess(const std::string& method,
                                              const std::atomic<bool>* interrupt) {
  plan_->methods = {planned_method(method, *plan_)};
  MethodStudy study(*plan_, 0);
  for (const auto& task : study.missing(plan_->steps)) {
    ProgressMeter meter(task.cost(), {});
    TaskShare share(meter, task.cost());
    auto run = assess_run(*plan_, task, share, interrupt);
    if (!run) return nullptr;
    study.take(task, std::move(*run));
  }
  study.assess(plan_->steps);
  record_.subjects = {study.finish({})};
  return &record_;
}

const record::CaseRecord* SystemStudy::assess(const SolverSubject& solver,
                                              const RefinementRequest& ladder,
                                              const std::atomic<bool>* interrupt) {
  const auto steps = plan_for(ladder, plan_->summary);
  SolverStudy study(solver, plan_->problem, plan_->summary, steps, interrupt);
  for (const auto& run : study.missing(steps)) study.make(run);
  study.assess(steps);
  if (interrupt != nullptr && *interrupt) return nullptr;
  record_.subjects = {study.finish()};
  return &record_;
}

CostEstimate SystemStudy::estimate(const std::string& method, bool timed) {
  plan_->methods = {planned_method(method, *plan_)};
  MethodStudy study(*plan_, 0);
  const auto tasks = study.missing(plan_->steps);
  if (!timed || tasks.empty()) return {tasks.size()};
  ProgressMeter meter(tasks.back().cost(), {});
  TaskShare share(meter, tasks.back().cost());
  study.take(tasks.back(), *assess_run(*plan_, tasks.back(), share, nullptr));
  return {tasks.size(), study.expected_seconds(tasks)};
}

CostEstimate SystemStudy::estimate(const SolverSubject& solver, const RefinementRequest& ladder,
                                   bool timed) {
  SolverStudy study(solver, plan_->problem, plan_->summary, plan_for(ladder, plan_->summary),
                    nullptr);
  const auto runs = study.missing(study.plan());
  if (timed && !runs.empty()) study.make(runs.front());
  return {runs.size(), study.expected_seconds(runs)};
}

record::CaseRecord refused_record(std::string_view case_name, std::string subject_name,
                                  const InputError& why) {
  record::CaseRecord record;
  record.problem.name = case_name;
  auto& subject = record.subjects.emplace_back();
  subject.name = std::move(subject_name);
  subject.refusal = why.what();
  subject.refusal_code = why.code().name();
  return record;
}

std::string subject_name(const std::string& method) {
  return short_name(methods::method(method)->facts().name);
}

}  // namespace clackers::study
