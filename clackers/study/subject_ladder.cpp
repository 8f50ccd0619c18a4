// The ladder of a subject: the runs that it needs and the levels that those made form.
#include <algorithm>
#include <cmath>

#include "clackers/judge/convergence/judge.hpp"
#include "clackers/judge/convergence/step_ladder.hpp"
#include "clackers/study/subject_study.hpp"

namespace clackers::study {
namespace {

// The longest run that is stored whole; a stored row takes some 50 bytes.
constexpr long long most_stored_rows = 262144;
// Runs of a method that diagnosis sees: the first of each of the finest levels.
constexpr std::size_t most_observed = 5;

// The number of steps that reach the end; only rounding parts some ends from a whole number.
long long steps_to(double end, double step) {
  return static_cast<long long>(std::ceil(end / step * (1.0 - 1e-12)));
}

// Behaviour that needs no cause: an order of smooth motion that is not lower than the method's.
bool is_as_smooth(const judge::LadderFit& fit, double smooth_order) {
  return fit.behaviour == Behaviour::exact ||
         (fit.behaviour == Behaviour::proper &&
          fit.order >= (1.0 - judge::order_tolerance) * smooth_order);
}

}  // namespace

std::vector<SubjectStudy::PlannedLevel> SubjectStudy::planned(
    const record::RefinementPlan& plan) const {
  std::vector<PlannedLevel> levels;
  const auto& summary = problem_.summary;
  if (!facts_.levels.empty() && !by_tolerance()) {
    for (const double step : facts_.levels)
      levels.push_back({step, {{step, steps_to(summary.end, step), 0.0}}});
    return levels;
  }
  const auto steps = judge::step_ladder(plan, summary.end, summary.impact_times);
  if (by_tolerance()) {
    solvers::SolverRun run{steps[0].steps[0], steps[0].counts[0], 0.0};
    long long count = 0;
    for (const double tolerance : facts_.levels) {
      run.tolerance = tolerance;
      if (is_method()) {
        const double per_period = 2.5 * std::pow(tolerance, -1.0 / facts_.order);
        count = std::max(count + 1, std::llround(per_period * summary.end / summary.fast_period));
        run.steps = count;
        run.step = summary.end / double(count);
      }
      levels.push_back({tolerance, {run}});
    }
    return levels;
  }
  for (const auto& level : steps) {
    auto& added = levels.emplace_back(PlannedLevel{level.nominal, {}});
    for (std::size_t i = 0; i < level.counts.size(); ++i)
      added.runs.push_back({level.steps[i], level.counts[i], 0.0});
  }
  return levels;
}

std::vector<RunTask> SubjectStudy::missing(const record::RefinementPlan& plan) const {
  std::vector<RunTask> tasks;
  if (!subject_.refusal.empty()) return tasks;
  const auto levels = planned(plan);
  const auto shown =
      std::ranges::find_if(levels.rbegin(), levels.rend(), [](const PlannedLevel& level) {
        return !level.runs.empty() && level.runs[0].steps < most_stored_rows;
      });
  for (const auto& level : levels)
    for (const auto& run : level.runs) {
      RunTask task{run};
      if (runs_.contains(task.resolution())) continue;
      if (is_method() && shown != levels.rend() && &run == shown->runs.data())
        task.wanted = of_shown_run_;
      tasks.push_back(task);
    }
  if (is_method()) std::ranges::reverse(tasks);
  return tasks;
}

std::vector<RunTask> SubjectStudy::to_observe() const {
  std::vector<RunTask> tasks;
  const auto& fit = subject_.assessment.displacement;
  // A contact of some length is the method's own model: no impact of it is at a wrong instant.
  if (!is_method() || is_as_smooth(fit, facts_.order) || subject_.contact_time > 0.0) return tasks;
  for (auto level = levels_.rbegin(); level != levels_.rend() && tasks.size() < most_observed;
       ++level) {
    const auto& [run, measured] = *level->runs.front();
    if (run.steps < most_stored_rows && measured.run.score.finished)
      tasks.push_back({run, {.observation = true}});
  }
  return tasks;
}

double SubjectStudy::expected_seconds(std::span<const RunTask> tasks, int threads) const {
  // Failed runs are short, and those of an earlier call have no time.
  const auto is_timed = [](const Made& made) {
    return made.measured.seconds > 0.0 && made.measured.run.score.finished;
  };
  long long longest = 0;
  for (const auto& [resolution, made] : runs_)
    if (is_timed(made)) longest = std::max(longest, made.run.steps);
  // Those of at least half the steps of the longest run; short ones are timed several times.
  double seconds = 0.0, steps = 0.0;
  for (const auto& [resolution, made] : runs_)
    if (is_timed(made) && 2 * made.run.steps > longest) {
      seconds += made.measured.seconds;
      steps += double(made.run.steps);
    }
  if (!(steps > 0.0)) return 0.0;
  double wanted = 0.0, most = 0.0;
  for (const auto& task : tasks) {
    wanted += double(task.run.steps);
    most = std::max(most, double(task.run.steps));
  }
  return std::max(most, wanted / (is_serial() ? 1 : threads)) * seconds / steps;
}

// The levels of the plan for methods, which are comparable then with each other; of others those that
// their steps form.
void SubjectStudy::group() {
  levels_.clear();
  subject_.complete = candidate_ == nullptr || missing(plan_).empty();
  if (is_method()) {
    for (const auto& level : planned(plan_)) {
      Level added{level.nominal, {}};
      for (const auto& run : level.runs)
        if (const auto made = runs_.find(RunTask{run}.resolution()); made != runs_.end())
          added.runs.push_back(&made->second);
      if (added.runs.size() == level.runs.size()) levels_.push_back(std::move(added));
    }
  } else {
    std::vector<double> steps;
    std::vector<Made*> runs;
    for (auto& [step, made] : runs_) {
      steps.push_back(step);
      runs.push_back(&made);
    }
    for (const auto& indices : judge::levels_of_steps(steps)) {
      auto& added = levels_.emplace_back(Level{steps[indices.front()], {}});
      for (const auto i : indices) added.runs.push_back(runs[i]);
    }
  }
  ladder_.clear();
  for (const auto& level : levels_) {
    auto& added = ladder_.emplace_back(measure::ScoreLevel{level.nominal, {}});
    for (const auto* made : level.runs) added.runs.push_back(made->measured.run.score);
  }
}

}  // namespace clackers::study
