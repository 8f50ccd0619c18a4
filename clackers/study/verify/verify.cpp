#include "clackers/study/verify.hpp"

#include <algorithm>

#include "clackers/assess/convergence/judge.hpp"
#include "clackers/study/verify/judged_run.hpp"
#include "clackers/study/verify/progress_meter.hpp"
#include "clackers/study/provenance.hpp"
#include "clackers/study/respond.hpp"
#include "clackers/study/verify/verify_plan.hpp"
#include "clackers/study/verify/work_queue.hpp"

namespace clackers::study {
namespace {

constexpr int history_bins = 400;

// The finest level whose first run metrics can be measured on; none: beyond the last.
std::size_t measured_level(const VerifyPlan& plan) {
  for (auto level = plan.ladder.size(); level-- > 0;)
    if (!plan.ladder[level].counts.empty() && plan.ladder[level].counts[0] < most_metric_rows)
      return level;
  return plan.ladder.size();
}

// Method after method, so that an interrupt leaves whole rows; within one the longest runs first,
// so that the short ones fill up the threads in the end.
std::vector<RunTask> tasks_of(const VerifyPlan& plan) {
  std::vector<RunTask> tasks;
  const auto middle = plan.ladder.size() / 2, measured = measured_level(plan);
  for (std::size_t m = 0; m < plan.methods.size(); ++m) {
    if (!plan.methods[m].result.refusal.empty()) continue;
    for (auto level = plan.ladder.size(); level-- > 0;)
      for (auto n = plan.ladder[level].steps.size(); n-- > 0;) {
        const bool shown = level == middle && n == 0;
        tasks.push_back({m, level, n, plan.ladder[level].steps[n], plan.ladder[level].counts[n],
                         shown ? history_bins : 0, level == measured && n == 0});
      }
  }
  return tasks;
}

using Results = std::vector<std::optional<JudgedRun>>;

Results run_tasks(const VerifyPlan& plan, const std::vector<RunTask>& tasks, int threads,
                  const Progress& progress, const std::atomic<bool>* interrupt) {
  double cost = 0.0;
  for (const auto& task : tasks) cost += task.cost();
  ProgressMeter meter(cost, progress);
  Results results(tasks.size());
  run_all(tasks.size(), threads, [&](std::size_t i) {
    TaskShare share(meter, tasks[i].cost());
    results[i] = judge_run(plan, tasks[i], share, interrupt);
  });
  if (std::ranges::all_of(results, [](const auto& one) { return one.has_value(); })) meter.finish();
  return results;
}

// Puts finished runs where they belong; a level that lacks one is left out.
void collect(VerifyPlan& plan, const std::vector<RunTask>& tasks, Results& results) {
  for (auto& planned : plan.methods)
    if (planned.result.refusal.empty())
      for (const auto& level : plan.ladder) {
        planned.result.ladder.push_back(
            {level.nominal, std::vector<assess::RunScore>(level.steps.size())});
        planned.ends.emplace_back(level.steps.size());
      }
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    auto& planned = plan.methods[tasks[i].method];
    auto& result = planned.result;
    auto& level = result.ladder[tasks[i].level];
    auto& ends = planned.ends[tasks[i].level];
    if (!results[i]) {
      result.complete = false;
      level.runs.clear();
      ends.clear();
    } else if (tasks[i].neighbour < level.runs.size()) {
      ends[tasks[i].neighbour] = {tasks[i].step, std::move(results[i]->end_u),
                                  results[i]->score.rounding_floor};
      level.runs[tasks[i].neighbour] = std::move(results[i]->score);
      if (tasks[i].history_bins > 0) {
        result.error_history = std::move(results[i]->history);
        result.history_step = tasks[i].step;
      }
      if (!results[i]->metrics.empty()) {
        result.metrics = std::move(results[i]->metrics);
        result.metrics_step = tasks[i].step;
      }
    }
  }
  for (auto& planned : plan.methods) {
    std::erase_if(planned.result.ladder, [](const auto& level) { return level.runs.empty(); });
    std::erase_if(planned.ends, [](const auto& level) { return level.empty(); });
  }
}

void assess_result(MethodResult& result) {
  if (!result.refusal.empty()) return;
  if (!result.ladder.empty()) {
    result.assessment = assess::judge(result.ladder, result.claim, result.contact_time);
    return;
  }
  result.assessment.displacement.reason = Code("interrupted").name();
  result.assessment.sentence = "Interrupted before a level was finished.";
}

// The true displacements at the end over the initial envelopes.
std::vector<double> true_end(const model::Motion& motion) {
  const auto end = motion.at(motion.end(), model::Side::right).u;
  const auto envelope = motion.envelope(0.0).u;
  std::vector<double> u;
  for (Eigen::Index i = 0; i < end.size(); ++i) u.push_back(end[i] / envelope[i]);
  return u;
}

// Without a claim through impacts a user expects the order of smooth motion.
void judge_without_reference(PlannedMethod& planned, std::span<const double> exact) {
  auto& result = planned.result;
  const double order =
      result.claim.order > 0.0 ? result.claim.order : planned.method->facts().smooth_order;
  if (planned.ends.empty() || !(order > 0.0)) return;
  result.self_convergence =
      self_result(std::move(planned.ends), exact,
                  {.claimed_order = order, .size = 1.0, .contact_time = result.contact_time});
}

}  // namespace

Record verify(const VerifyRequest& request, const Progress& progress,
              const std::atomic<bool>* interrupt) {
  const int threads = thread_count(request.jobs);
  auto plan = plan_of(request);
  const auto tasks = tasks_of(plan);
  auto results = run_tasks(plan, tasks, threads, progress, interrupt);
  collect(plan, tasks, results);

  Record record;
  record.provenance = provenance(request.command);
  record.problem = std::move(plan.summary);
  record.plan = request.plan;
  record.response = response_curve(plan.problem, response_points);
  const auto exact = true_end(*plan.problem.motion);
  for (auto& planned : plan.methods) {
    assess_result(planned.result);
    judge_without_reference(planned, exact);
    record.interrupted = record.interrupted || !planned.result.complete;
    record.methods.push_back(std::move(planned.result));
  }
  record.profiles = profiles_of({&record, 1});
  return record;
}

}  // namespace clackers::study
