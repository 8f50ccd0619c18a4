#include "clackers/study/verify/assessed_run.hpp"

#include <time.h>

#include <cmath>

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/errors/error_sink.hpp"
#include "clackers/model/trajectory.hpp"
#include "clackers/record/all_metrics.hpp"
#include "clackers/record/reduced_curve.hpp"
#include "clackers/study/verify/run_sinks.hpp"

namespace clackers::study {
namespace {

// Costs of a state, relative: with errors, for timing only, with metrics.
constexpr double error_state = 1.0, timed_state = 0.5, measured_state = 10.0;

// The clock of a thread costs and errs by less than a microsecond: a thousandth of this.
constexpr double shortest_timing = 1e-3;  // [s]
constexpr int most_repetitions = 1000;

record::Curve curve_of(const measure::ErrorHistory& history, int dof) {
  record::Curve curve;
  curve.t = history.times();
  for (int i = 0; i < dof; ++i) curve.y.push_back(history.largest(i));
  return curve;
}

// The points of a run that an animation needs; the whole run would fill memory.
record::Curve motion_of(const model::Trajectory& history) {
  constexpr std::size_t most = 500;
  const auto dof = std::size_t(history.dof);
  return record::reduced(
      history.t.size(), dof, [&](std::size_t row) { return history.t[row]; },
      [&](std::size_t mass, std::size_t row) { return history.u[row * dof + mass]; }, most);
}

// Displacements over the largest envelopes.
std::vector<double> relative(std::vector<double> u, const model::Motion& motion) {
  const auto envelope = motion.peak().u;
  for (std::size_t i = 0; i < u.size(); ++i) u[i] /= envelope[Eigen::Index(i)];
  return u;
}

// Of this thread [s].
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// Processor time of one run [s]; nothing when interrupted.
std::optional<double> time_of(model::Run& run, model::Sink& sink) {
  const double start = processor_time();
  double used = 0.0;
  int runs = 0;
  while (used < shortest_timing && runs < most_repetitions) {
    if (run.advance(sink).stopped_by_sink) return {};
    used = processor_time() - start;
    ++runs;
  }
  return used / runs;
}

}  // namespace

double RunTask::cost() const {
  return (error_state + timed_state + (metrics ? measured_state : 0.0)) * double(steps);
}

std::optional<AssessedRun> assess_run(const CasePlan& plan, const RunTask& task, TaskShare& share,
                                      const std::atomic<bool>* interrupt) {
  if (interrupt != nullptr && *interrupt) return {};
  const double start = processor_time();
  const auto& method = plan.methods[task.method];
  const auto& motion = *plan.problem.motion;
  const bool by_tolerance = method.subject.resolution == record::Resolution::tolerance;
  const auto run = method.method->prepare(
      plan.problem.problem,
      by_tolerance ? methods::Resolution::by_tolerance(task.step) : methods::Resolution(task.step));
  const double step = by_tolerance ? plan.summary.end / double(task.steps) : task.step;
  measure::ErrorSink errors(
      motion, plan.problem.problem, step,
      {.impacts_are_reported = method.reports_impacts, .history_bins = task.history_bins});
  model::TrajectorySink stored(method.reports_impacts);
  RunRecorder recorder(errors, task.metrics ? &stored : nullptr);
  WatchedSink watched(&recorder, share, error_state, interrupt);
  const auto outcome = run->advance(watched);
  if (outcome.stopped_by_sink) return {};
  AssessedRun result;
  result.run.score = errors.score(outcome);
  result.run.score.step = task.step;
  if (task.history_bins > 0) result.run.error_history = curve_of(errors.history(), motion.dof());
  result.seconds = processor_time() - start;
  if (!outcome.finished) return result;
  result.end_u = relative(recorder.last_u(), motion);
  // A state that is not finite is no row of a history.
  if (task.metrics && std::isfinite(result.run.score.u_error)) {
    auto metrics = all_metrics({stored.trajectory(), motion, plan.problem.problem,
                                facts_of(plan.summary, plan.problem.problem, method.spring_time)},
                               {}, interrupt);
    if (!metrics) return {};
    result.run.metrics = std::move(*metrics);
    if (plan.extras.record && motion.dof() <= record::most_blocks)
      result.run.motion = motion_of(stored.trajectory());
  }
  if (!plan.extras.times) {
    result.run.score.seconds = result.seconds;
    return result;
  }
  WatchedSink timed(nullptr, share, timed_state, interrupt);
  const auto seconds = time_of(*run, timed);
  if (!seconds) return {};
  result.run.score.seconds = *seconds;
  result.seconds = processor_time() - start;
  return result;
}

}  // namespace clackers::study
