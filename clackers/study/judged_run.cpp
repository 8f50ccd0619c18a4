#include "clackers/study/judged_run.hpp"

#include <cmath>

#include "clackers/assess/errors/comparison.hpp"
#include "clackers/assess/errors/error_sink.hpp"
#include "clackers/model/trajectory.hpp"
#include "clackers/study/cause_metrics.hpp"
#include "clackers/study/processor_time.hpp"
#include "clackers/study/run_recorder.hpp"
#include "clackers/study/watched_sink.hpp"

namespace clackers::study {
namespace {

// A state under judgement needs the true motion, one without only the method, one under all metrics
// both and a search. Only the progress shown depends on these.
constexpr double judged_state = 1.0, timed_state = 0.2, measured_state = 10.0;

// The clock of a thread costs and errs by less than a microsecond: a thousandth of this.
constexpr double shortest_timing = 1e-3;  // [s]
constexpr int most_repetitions = 1000;

Curve curve_of(const assess::ErrorHistory& history, int dof) {
  Curve curve;
  curve.t = history.times();
  for (int i = 0; i < dof; ++i) curve.y.push_back(history.largest(i));
  return curve;
}

// Displacements over the initial envelopes.
std::vector<double> relative(std::vector<double> u, const model::Motion& motion) {
  const auto envelope = motion.envelope(0.0).u;
  for (std::size_t i = 0; i < u.size(); ++i) u[i] /= envelope[Eigen::Index(i)];
  return u;
}

// Processor time of one run [s]; nothing when interrupted.
std::optional<double> time_of(model::Run& run, model::Sink& sink) {
  const double start = thread_processor_time();
  double used = 0.0;
  int runs = 0;
  while (used < shortest_timing && runs < most_repetitions) {
    if (run.advance(sink).stopped_by_sink) return {};
    used = thread_processor_time() - start;
    ++runs;
  }
  return used / runs;
}

}  // namespace

double RunTask::cost() const {
  return (judged_state + timed_state + (metrics ? measured_state : 0.0)) * double(steps);
}

std::optional<JudgedRun> judge_run(const VerifyPlan& plan, const RunTask& task, TaskShare& share,
                                   const std::atomic<bool>* interrupt) {
  if (interrupt != nullptr && *interrupt) return {};
  const auto& method = plan.methods[task.method];
  const auto& motion = *plan.problem.motion;
  const auto run = method.method->prepare(plan.problem.problem, task.step);
  assess::ErrorSink judge(motion, plan.problem.problem, task.step,
                          {method.reports_impacts, task.history_bins});
  model::TrajectorySink stored(method.reports_impacts);
  RunRecorder recorder(judge, task.metrics ? &stored : nullptr);
  WatchedSink judged(&recorder, share, judged_state, interrupt);
  const auto outcome = run->advance(judged);
  if (outcome.stopped_by_sink) return {};
  JudgedRun result{judge.score(outcome), {}, {}, {}};
  if (task.history_bins > 0) result.history = curve_of(judge.history(), motion.dof());
  if (!outcome.finished) return result;
  result.end_u = relative(recorder.last_u(), motion);
  // A state that is not finite is no row of a history.
  if (task.metrics && std::isfinite(result.score.u_error))
    result.metrics = all_metrics({stored.trajectory(), motion, plan.problem.problem},
                                 facts_of(plan.summary, method.result.contact_time));
  WatchedSink timed(nullptr, share, timed_state, interrupt);
  const auto seconds = time_of(*run, timed);
  if (!seconds) return {};
  result.score.seconds = *seconds;
  return result;
}

}  // namespace clackers::study
