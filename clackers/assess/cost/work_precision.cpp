#include "clackers/assess/cost/work_precision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"

namespace clackers::assess {
namespace {

constexpr auto who = "work and precision";

// `runs` ascend by work, then by error: a run is dominated by any before it with as small an error,
// unless both numbers are equal.
void mark_front(std::vector<WorkPoint>& runs) {
  const WorkPoint* best = nullptr;
  for (auto& run : runs) {
    run.on_front = best == nullptr || run.error < best->error ||
                   (run.error == best->error && run.work == best->work);
    if (run.on_front) best = &run;
  }
}

}  // namespace

std::string_view to_string(Counter counter) {
  switch (counter) {
    case Counter::steps:
      return "steps";
    case Counter::force_evaluations:
      return "force evaluations";
    case Counter::factorizations:
      return "factorizations";
    case Counter::newton_iterations:
      return "Newton iterations";
    case Counter::event_searches:
      return "event searches";
    case Counter::seconds:
      break;
  }
  return "seconds";
}

double cost(const RunScore& run, Counter counter) {
  switch (counter) {
    case Counter::steps:
      return double(run.work.steps);
    case Counter::force_evaluations:
      return double(run.work.force_evaluations);
    case Counter::factorizations:
      return double(run.work.factorizations);
    case Counter::newton_iterations:
      return double(run.work.newton_iterations);
    case Counter::event_searches:
      return double(run.work.event_searches);
    case Counter::seconds:
      break;
  }
  return run.seconds;
}

WorkCurve work_curve(const Ladder& ladder, Counter counter, const ErrorMeasure& error) {
  WorkCurve curve;
  curve.counter = counter;
  for (const auto& level : ladder) {
    WorkLevel worst{.step = level.step};
    for (const auto& run : level.runs) {
      const double work = cost(run, counter);
      const double off = error ? error(run) : run.u_error;
      if (off < 0.0) refuse(who, "error", off, "0 or more");
      curve.counts = curve.counts || work > 0.0;
      worst.work = std::max(worst.work, work);
      if (run.finished && std::isfinite(off)) {
        worst.error = std::max(worst.error, off);
        curve.runs.push_back({run.step, work, off});
      } else {
        worst.error = std::numeric_limits<double>::infinity();
        curve.failures.push_back({run.step, work, run.failure_code});
      }
    }
    if (!level.runs.empty()) curve.envelope.push_back(worst);
  }
  std::ranges::stable_sort(
      curve.runs, {}, [](const WorkPoint& point) { return std::tuple(point.work, point.error); });
  mark_front(curve.runs);
  return curve;
}

std::optional<double> work_for(const WorkCurve& curve, double error) {
  require_positive(who, "error to reach", error);
  std::optional<double> least;
  for (auto level = curve.envelope.rbegin(); level != curve.envelope.rend(); ++level) {
    if (!(level->error <= error)) break;
    least = least ? std::min(*least, level->work) : level->work;
  }
  return least;
}

}  // namespace clackers::assess
