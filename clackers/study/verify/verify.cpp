#include "clackers/study/verify.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/base/jobs/work_queue.hpp"
#include "clackers/record/provenance.hpp"
#include "clackers/study/verify/method_study.hpp"
#include "clackers/study/verify/verify_plan.hpp"
#include "clackers/tables/respond.hpp"

namespace clackers::study {
namespace {

// The studies of one case, a method each.
using CaseStudies = std::vector<MethodStudy>;

struct Task {
  MethodStudy* study;
  RunTask run;
};

// What a ladder lacks.
struct Round {
  MethodStudy* study;
  record::RefinementPlan steps;
  std::vector<RunTask> missing;
  double seconds = 0.0;  // expected
};

// Runs tasks in their order and hands their studies the results.
void run_tasks(const std::vector<Task>& tasks, int threads, const Progress& progress,
               const std::atomic<bool>* interrupt) {
  double cost = 0.0;
  for (const auto& task : tasks) cost += task.run.cost();
  ProgressMeter meter(cost, progress);
  std::vector<std::optional<AssessedRun>> results(tasks.size());
  run_all(tasks.size(), threads, [&](std::size_t i) {
    TaskShare share(meter, tasks[i].run.cost());
    results[i] = assess_run(tasks[i].study->plan(), tasks[i].run, share, interrupt);
  });
  for (std::size_t i = 0; i < tasks.size(); ++i)
    if (results[i]) tasks[i].study->take(tasks[i].run, std::move(*results[i]));
  if (interrupt == nullptr || !*interrupt) meter.finish();
}

// Case after case and method after method, so that an interrupt leaves whole rows.
void run_rounds(const std::vector<Round>& rounds, int threads, const Progress& progress,
                const std::atomic<bool>* interrupt) {
  std::vector<Task> tasks;
  for (const auto& round : rounds)
    for (const auto& task : round.missing) tasks.push_back({round.study, task});
  run_tasks(tasks, threads, progress, interrupt);
}

// The next rounds of all open studies, those that end removed.
std::vector<Round> next_rounds(std::vector<CaseStudies>& cases, int threads) {
  std::vector<Round> rounds;
  for (auto& studies : cases)
    for (auto& study : studies) {
      if (study.is_closed()) continue;
      const auto next = study.next();
      if (!next.plan) {
        study.close(next.end);
        continue;
      }
      auto missing = study.missing(*next.plan);
      const double longest = study.expected_seconds({missing.data(), missing.empty() ? 0u : 1u});
      const double seconds = std::max(longest, study.expected_seconds(missing) / threads);
      rounds.push_back({&study, *next.plan, std::move(missing), seconds});
    }
  return rounds;
}

// Those that fit together into the time left, the shortest ones; what does not fit alone ends.
std::vector<Round> affordable(std::vector<Round> rounds, double left) {
  std::ranges::stable_sort(rounds, {}, &Round::seconds);
  double sum = 0.0;
  std::erase_if(rounds, [&](const Round& round) {
    if (!(round.seconds <= left)) round.study->close(record::RefinementEnd::budget, round.seconds);
    sum += round.seconds;
    return !(sum <= left);
  });
  return rounds;
}

// False when interrupted: the last round is left out.
bool refine(std::vector<CaseStudies>& cases, double budget, int threads, const Progress& progress,
            const std::atomic<bool>* interrupt) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  for (;;) {
    const double used = std::chrono::duration<double>(Clock::now() - start).count();
    const auto rounds = affordable(next_rounds(cases, threads), budget - used);
    if (rounds.empty()) return true;
    run_rounds(rounds, threads, progress, interrupt);
    if (interrupt != nullptr && *interrupt) {
      for (const auto& round : rounds) round.study->close(record::RefinementEnd::interrupted);
      return false;
    }
    for (const auto& round : rounds) round.study->assess(round.steps);
  }
}

void require_budget(double budget) {
  if (!(budget >= 0.0 && std::isfinite(budget)))
    refuse("verify", "budget", budget, "0 s or more", "0 refines nothing beyond the plan.");
}

// The reference displacements at the end over the largest envelopes.
std::vector<double> reference_end(const model::Motion& motion) {
  const auto end = motion.at(motion.end(), model::Side::right).u;
  const auto envelope = motion.peak().u;
  std::vector<double> u;
  for (Eigen::Index i = 0; i < end.size(); ++i) u.push_back(end[i] / envelope[i]);
  return u;
}

record::CaseRecord case_record(const CasePlan& plan, CaseStudies& studies) {
  record::CaseRecord record;
  record.problem = plan.summary;
  record.plan = plan.steps;
  record.response = tables::response_curve(plan.problem, tables::response_points);
  const auto exact = reference_end(*plan.problem.motion);
  for (auto& study : studies) record.subjects.push_back(study.finish(exact));
  record.profiles = record::profiles_of({&record, 1});
  return record;
}

}  // namespace

record::Record verify(const VerifyRequest& request, const Progress& progress,
                      const std::atomic<bool>* interrupt) {
  const int threads = thread_count(request.jobs);
  require_budget(request.budget);
  if (!request.tolerances.empty() && !has_adaptive_method(request))
    refuse("verify", "tolerances", request.tolerances.front(),
           "those of a method that is adaptive, such as dopri5", {}, "wrong-resolution");
  const auto plans = plans_of(request);
  std::vector<CaseStudies> cases;
  std::vector<Round> rounds;
  for (const auto& plan : plans) {
    auto& studies = cases.emplace_back();
    for (std::size_t m = 0; m < plan.methods.size(); ++m) studies.emplace_back(plan, m);
  }
  for (auto& studies : cases)
    for (auto& study : studies)
      rounds.push_back({&study, study.plan().steps, study.missing(study.plan().steps)});
  run_rounds(rounds, threads, progress, interrupt);
  for (const auto& round : rounds) round.study->assess(round.steps);
  bool is_whole = true;
  if (request.budget > 0.0 && (interrupt == nullptr || !*interrupt))
    is_whole =
        refine(cases, request.budget, std::min(threads, thread_count(0)), progress, interrupt);

  record::Record record;
  record.command = "verify";
  record.provenance = record::provenance(request.command);
  for (std::size_t c = 0; c < plans.size(); ++c)
    record.cases.push_back(case_record(plans[c], cases[c]));
  record.interrupted = counts(record).interrupted > 0 || !is_whole;
  if (record.cases.size() > 1) record.profiles = profiles_of(record.cases);
  return record;
}

}  // namespace clackers::study
