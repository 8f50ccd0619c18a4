#include "clackers/judge/cost/work_precision.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"

namespace clackers::judge {
namespace {

constexpr auto work_precision_name = "work and precision";

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

double cost(const measure::RunScore& run, Counter counter) {
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

WorkCurve work_curve(const measure::Ladder& ladder, Counter counter) {
  WorkCurve curve;
  for (const auto& level : ladder) {
    if (level.runs.empty()) continue;
    auto runs = level.runs;
    for (auto& run : runs) {
      if (run.u_error < 0.0) refuse(work_precision_name, "error", run.u_error, "0 or more");
      run.finished = run.finished && std::isfinite(run.u_error);
      if (run.finished) curve.runs.push_back({run.step, cost(run, counter), run.u_error});
    }
    const auto largest = worst(runs);
    curve.envelope.push_back(
        {.step = level.step,
         .work = cost(largest, counter),
         .error = largest.u_error,
         .failed = int(std::ranges::count(runs, false, &measure::RunScore::finished))});
  }
  std::ranges::stable_sort(
      curve.runs, {}, [](const WorkPoint& point) { return std::tuple(point.work, point.error); });
  mark_front(curve.runs);
  return curve;
}

std::optional<double> work_for(const WorkCurve& curve, double error) {
  require_positive(work_precision_name, "error to reach", error);
  std::optional<double> least;
  for (auto level = curve.envelope.rbegin(); level != curve.envelope.rend(); ++level) {
    if (level->failed > 0 || !(level->error <= error)) break;
    least = least ? std::min(*least, level->work) : level->work;
  }
  return least;
}

}  // namespace clackers::judge
