#include "clackers/study/verify.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "clackers/assess/convergence/judge.hpp"
#include "clackers/study/provenance.hpp"
#include "clackers/study/respond.hpp"
#include "clackers/study/verify/assessed_run.hpp"
#include "clackers/study/verify/verify_plan.hpp"
#include "clackers/study/verify/work_queue.hpp"

namespace clackers::study {
namespace {

constexpr int history_bins = 400;
// The longest run that metrics are measured on; a stored row takes some 50 bytes.
constexpr long long most_metric_rows = 262144;

// The runs of one method by level and sample; nothing for those that were not finished.
using MethodRuns = std::vector<std::vector<std::optional<AssessedRun>>>;
// The same by case and method.
using Results = std::vector<std::vector<MethodRuns>>;

Results results_for(const std::vector<CasePlan>& plans) {
  Results results;
  for (const auto& plan : plans) {
    MethodRuns runs;
    for (const auto& level : plan.levels) runs.emplace_back(level.steps.size());
    results.emplace_back(plan.methods.size(), runs);
  }
  return results;
}

// The finest level whose first run metrics can be measured on; none: beyond the last.
std::size_t measured_level(const CasePlan& plan) {
  for (auto level = plan.levels.size(); level-- > 0;)
    if (!plan.levels[level].counts.empty() && plan.levels[level].counts[0] < most_metric_rows)
      return level;
  return plan.levels.size();
}

// Case after case and method after method, so that an interrupt leaves whole rows; within one the
// longest runs first, so that the short ones fill up the threads in the end.
std::vector<RunTask> tasks_of(const std::vector<CasePlan>& plans) {
  std::vector<RunTask> tasks;
  for (std::size_t c = 0; c < plans.size(); ++c) {
    const auto& plan = plans[c];
    const auto measured = measured_level(plan);
    for (std::size_t m = 0; m < plan.methods.size(); ++m) {
      if (!plan.methods[m].subject.refusal.empty()) continue;
      for (auto level = plan.levels.size(); level-- > 0;)
        for (auto n = plan.levels[level].steps.size(); n-- > 0;) {
          const bool shown = level == measured && n == 0;
          tasks.push_back({c, m, level, n, plan.levels[level].steps[n],
                           plan.levels[level].counts[n], shown ? history_bins : 0, shown});
        }
    }
  }
  return tasks;
}

Results run_tasks(const std::vector<CasePlan>& plans, int threads, const Progress& progress,
                  const std::atomic<bool>* interrupt) {
  const auto tasks = tasks_of(plans);
  double cost = 0.0;
  for (const auto& task : tasks) cost += task.cost();
  ProgressMeter meter(cost, progress);
  auto results = results_for(plans);
  run_all(tasks.size(), threads, [&](std::size_t i) {
    const auto& task = tasks[i];
    TaskShare share(meter, task.cost());
    results[task.problem][task.method][task.level][task.sample] =
        assess_run(plans[task.problem], task, share, interrupt);
  });
  if (interrupt == nullptr || !*interrupt) meter.finish();
  return results;
}

// Without a claim through impacts a user expects the order of smooth motion.
std::optional<SelfResult> self_convergence(const PlannedMethod& planned, const Subject& subject,
                                           std::vector<assess::ResponseLevel> ends,
                                           std::span<const double> exact) {
  const double order =
      subject.claim.order > 0.0 ? subject.claim.order : planned.method->facts().smooth_order;
  if (ends.empty() || !(order > 0.0)) return {};
  return self_result(std::move(ends), exact,
                     {.claimed_order = order, .size = 1.0, .contact_time = subject.contact_time});
}

// The subject with its runs; a level that lacks one is left out.
Subject assessed(const CasePlan& plan, const PlannedMethod& planned, MethodRuns runs,
                 std::span<const double> exact) {
  auto subject = planned.subject;
  if (!subject.refusal.empty()) return subject;
  std::vector<assess::ResponseLevel> ends;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const bool whole =
        std::ranges::all_of(runs[i], [](const auto& run) { return run.has_value(); });
    subject.complete = subject.complete && whole;
    if (!whole) continue;
    subject.levels.push_back({plan.levels[i].nominal, {}});
    ends.emplace_back();
    for (auto& found : runs[i]) {
      const auto& score = found->run.score;
      ends.back().push_back({score.step, std::move(found->end_u), score.rounding_floor});
      subject.levels.back().runs.push_back(std::move(found->run));
    }
  }
  if (subject.levels.empty())
    subject.assessment.reason = subject.assessment.displacement.reason = Code("interrupted").name();
  else
    subject.assessment =
        assess::judge(ladder_of(subject), subject.claim, {.contact_time = subject.contact_time});
  subject.self_convergence = self_convergence(planned, subject, std::move(ends), exact);
  return subject;
}

// The reference displacements at the end over the initial envelopes.
std::vector<double> reference_end(const model::Motion& motion) {
  const auto end = motion.at(motion.end(), model::Side::right).u;
  const auto envelope = motion.envelope(0.0).u;
  std::vector<double> u;
  for (Eigen::Index i = 0; i < end.size(); ++i) u.push_back(end[i] / envelope[i]);
  return u;
}

CaseRecord case_record(const CasePlan& plan, const RefinementPlan& steps,
                       std::vector<MethodRuns> runs) {
  CaseRecord record;
  record.problem = plan.summary;
  record.plan = steps;
  record.response = response_curve(plan.problem, response_points);
  const auto exact = reference_end(*plan.problem.motion);
  for (std::size_t m = 0; m < plan.methods.size(); ++m)
    record.subjects.push_back(assessed(plan, plan.methods[m], std::move(runs[m]), exact));
  record.profiles = profiles_of({&record, 1});
  return record;
}

}  // namespace

Record verify(const VerifyRequest& request, const Progress& progress,
              const std::atomic<bool>* interrupt) {
  const int threads = thread_count(request.jobs);
  const auto plans = plans_of(request);
  auto results = run_tasks(plans, threads, progress, interrupt);

  Record record;
  record.command = "verify";
  record.provenance = provenance(request.command);
  for (std::size_t c = 0; c < plans.size(); ++c) {
    record.cases.push_back(case_record(plans[c], request.plan, std::move(results[c])));
    record.interrupted = record.interrupted || counts(record.cases.back()).interrupted > 0;
  }
  if (record.cases.size() > 1) record.profiles = profiles_of(record.cases);
  return record;
}

}  // namespace clackers::study
