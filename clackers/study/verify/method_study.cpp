#include "clackers/study/verify/method_study.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "clackers/base/codes.hpp"
#include "clackers/judge/convergence/judge.hpp"

namespace clackers::study {
namespace {

constexpr int history_bins = 400;
// The longest run that metrics are measured on; a stored row takes some 50 bytes.
constexpr long long most_metric_rows = 262144;

// The finest level whose first run metrics can be measured on; none: beyond the last.
std::size_t measured_level(const std::vector<judge::StepLevel>& levels) {
  for (auto level = levels.size(); level-- > 0;)
    if (!levels[level].counts.empty() && levels[level].counts[0] < most_metric_rows) return level;
  return levels.size();
}

std::optional<measure::SharedImpacts> shared_impacts(const CasePlan& plan,
                                                     const record::Subject& subject) {
  const auto* run = subject.shown_run();
  if (!plan.shared || run == nullptr) return {};
  return measure::at_shared_instant(*plan.shared, plan.problem.problem.start.t,
                                    run->error_history.t, run->error_history.y);
}

// Without a claim through impacts a user expects the order of smooth motion.
std::optional<record::SelfResult> self_convergence(const PlannedMethod& planned,
                                                   const record::Subject& subject,
                                                   std::vector<judge::ResponseLevel> ends,
                                                   std::span<const double> exact) {
  const double order =
      subject.claim.order > 0.0 ? subject.claim.order : planned.method->facts().smooth_order;
  if (ends.empty() || !(order > 0.0) || !std::isfinite(order)) return {};
  return record::self_result(
      std::move(ends), exact,
      {.claimed_order = order, .size = 1.0, .contact_time = subject.contact_time});
}

}  // namespace

MethodStudy::MethodStudy(const CasePlan& plan, std::size_t method)
    : plan_(&plan),
      method_(method),
      steps_(plan.steps),
      subject_(plan.methods[method].subject),
      is_closed_(!subject_.refusal.empty()) {}

std::vector<RunTask> MethodStudy::missing(const record::RefinementPlan& steps) const {
  std::vector<RunTask> tasks;
  if (!subject_.refusal.empty()) return tasks;
  const auto levels = levels_of(*plan_, plan_->methods[method_], steps);
  const auto measured = measured_level(levels);
  for (auto level = levels.size(); level-- > 0;)
    for (auto n = levels[level].counts.size(); n-- > 0;) {
      const auto count = levels[level].counts[n];
      if (runs_.contains(count)) continue;
      const bool shown = level == measured && n == 0;
      const auto& extras = plan_->extras;
      // Impacts of one instant are judged by the errors around it.
      const bool has_history = shown && (extras.record || plan_->shared);
      tasks.push_back({method_, levels[level].steps[n], count, has_history ? history_bins : 0,
                       shown && extras.metrics});
    }
  return tasks;
}

double MethodStudy::expected_seconds(std::span<const RunTask> tasks) const {
  if (runs_.empty()) return 0.0;
  // Those of at least half the steps of the longest run; short ones are timed several times.
  const auto longest = runs_.rbegin()->first;
  double seconds = 0.0, steps = 0.0;
  for (auto run = runs_.rbegin(); run != runs_.rend() && 2 * run->first > longest; ++run) {
    seconds += run->second.seconds;
    steps += double(run->first);
  }
  double wanted = 0.0;
  for (const auto& task : tasks) wanted += double(task.steps);
  return wanted * seconds / steps;
}

void MethodStudy::take(const RunTask& task, AssessedRun run) {
  runs_.insert_or_assign(task.steps, std::move(run));
}

void MethodStudy::assess(const record::RefinementPlan& steps) {
  steps_ = steps;
  if (!subject_.refusal.empty()) return;
  subject_.complete = true;
  subject_.levels.clear();
  for (const auto& level : levels_of(*plan_, plan_->methods[method_], steps)) {
    const bool is_whole =
        std::ranges::all_of(level.counts, [&](long long count) { return runs_.contains(count); });
    subject_.complete = subject_.complete && is_whole;
    if (!is_whole) continue;
    auto& added = subject_.levels.emplace_back(record::Level{level.nominal, {}});
    for (const auto count : level.counts) added.runs.push_back(runs_.at(count).run);
  }
  auto& assessment = subject_.assessment;
  if (subject_.levels.empty())
    assessment.reason = assessment.displacement.reason = Code("interrupted").name();
  else
    assessment =
        judge::judge(ladder_of(subject_), subject_.claim,
                     {.contact_time = subject_.contact_time,
                      .shared = shared_impacts(*plan_, subject_),
                      .by_tolerance = subject_.resolution == record::Resolution::tolerance});
}

NextPlan MethodStudy::next() const {
  if (subject_.resolution == record::Resolution::tolerance) return {};
  return next_plan(subject_, steps_, plan_->summary);
}

void MethodStudy::close(record::RefinementEnd end, double next_seconds) {
  is_closed_ = true;
  subject_.refinement = refinement_of(plan_->steps, steps_, end, next_seconds);
}

record::Subject MethodStudy::finish(std::span<const double> exact) {
  if (plan_->extras.record && subject_.refusal.empty() &&
      subject_.resolution == record::Resolution::step) {
    std::vector<judge::ResponseLevel> ends;
    for (const auto& level : subject_.levels) {
      ends.emplace_back();
      for (const auto& run : level.runs) {
        const auto& score = run.score;
        const auto count = std::llround(plan_->summary.end / score.step);
        ends.back().push_back({score.step, std::move(runs_.at(count).end_u), score.rounding_floor});
      }
    }
    subject_.self_convergence =
        self_convergence(plan_->methods[method_], subject_, std::move(ends), exact);
  }
  return std::move(subject_);
}

}  // namespace clackers::study
