#include "clackers/study/system_study.hpp"

#include <algorithm>
#include <utility>

#include "clackers/methods/registry.hpp"
#include "clackers/study/method_candidate.hpp"
#include "clackers/study/solver_candidate.hpp"
#include "clackers/study/verify.hpp"

namespace clackers::study {
namespace {

void make(SubjectStudy& study, const RunTask& task, const std::atomic<bool>* interrupt) {
  ProgressMeter meter(study.cost(task), {});
  TaskShare share(meter, study.cost(task));
  study.make(task, share, interrupt);
}

}  // namespace

SystemStudy::SystemStudy(const SystemRequest& request, cases::Case problem)
    : request_(request), problem_(study_case(std::move(problem))) {
  record_.problem = problem_.summary;
  record_.plan = checked_plan(request_.plan, problem_, LadderKind::methods);
}

std::unique_ptr<SubjectStudy> SystemStudy::study_of(const Subject& subject) const {
  if (const auto* solver = std::get_if<const solvers::SolverSubject*>(&subject))
    return std::make_unique<SubjectStudy>(
        problem_, std::make_unique<SolverCandidate>(**solver, problem_),
        plan_for(request_.plan, problem_.summary, LadderKind::solvers));
  const Extras extras{.record = false, .times = request_.times};
  // Impacts of one instant are judged by the errors around it.
  const Wanted shown{.history_bins = problem_.shared.empty() ? 0 : history_bins,
                     .metrics = request_.metrics};
  return std::make_unique<SubjectStudy>(
      problem_,
      std::make_unique<MethodCandidate>(methods::method(std::get<std::string>(subject)), problem_,
                                        tolerances_of(request_.plan), extras),
      record_.plan, shown);
}

const record::CaseRecord* SystemStudy::assess(const Subject& subject,
                                              const std::atomic<bool>* interrupt) {
  const auto study = study_of(subject);
  const auto tasks = study->missing(study->plan());
  study->expect(tasks);
  for (const auto& task : tasks) make(*study, task, interrupt);
  if (interrupt != nullptr && *interrupt) return nullptr;
  study->assess(study->plan());
  record_.subjects.clear();
  record_.subjects.push_back(study->finish());
  return &record_;
}

CostEstimate SystemStudy::estimate(const Subject& subject, bool timed) {
  const auto study = study_of(subject);
  const auto tasks = study->missing(study->plan());
  if (!timed || tasks.empty()) return {tasks.size()};
  make(*study,
       *std::ranges::min_element(tasks, {}, [](const RunTask& task) { return task.run.steps; }),
       nullptr);
  return {tasks.size(), study->expected_seconds(tasks)};
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
  return methods::short_name(methods::method(method)->facts().name);
}

}  // namespace clackers::study
