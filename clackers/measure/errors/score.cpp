#include "clackers/measure/errors/score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clackers::measure {
namespace {

void raise(double& largest, double value) {
  if (std::isnan(value) || value > largest) largest = value;
}

void raise(model::Work& largest, const model::Work& work) {
  for (const auto count :
       {&model::Work::steps, &model::Work::force_evaluations, &model::Work::factorizations,
        &model::Work::newton_iterations, &model::Work::event_searches})
    largest.*count = std::max(largest.*count, work.*count);
}

// Gain and loss by the same factor are equally far; a ratio of 0 or below is farthest.
double distance_from_one(double ratio) {
  return ratio > 0.0 ? std::abs(std::log(ratio)) : std::numeric_limits<double>::infinity();
}

void add(std::optional<ImpactScore>& worst, const ImpactScore& score) {
  if (!worst) {
    worst = score;
    return;
  }
  const auto wrong = [](const ImpactScore& impacts) { return impacts.missed + impacts.extra; };
  double time_error = worst->worst_time_error, floor = worst->rounding_floor;
  raise(time_error, score.worst_time_error);
  raise(floor, score.rounding_floor);
  if (wrong(score) > wrong(*worst)) worst = score;
  worst->worst_time_error = time_error;
  worst->rounding_floor = floor;
}

}  // namespace

RunScore worst(std::span<const RunScore> runs) {
  RunScore result;
  if (!runs.empty()) result.step = runs.front().step;
  for (const auto& run : runs) {
    if (!run.finished) continue;
    if (!result.finished) {
      const double step = result.step;
      result = run;
      result.step = step;
      continue;
    }
    for (const auto error :
         {&RunScore::u_error, &RunScore::u_error_absolute, &RunScore::v_error,
          &RunScore::energy_error, &RunScore::rounding_floor, &RunScore::seconds})
      raise(result.*error, run.*error);
    if (!(distance_from_one(run.energy_ratio) <= distance_from_one(result.energy_ratio)))
      result.energy_ratio = run.energy_ratio;
    if (run.impacts) add(result.impacts, *run.impacts);
    raise(result.work, run.work);
  }
  if (result.finished) return result;
  for (const auto value : {&RunScore::u_error, &RunScore::u_error_absolute, &RunScore::v_error,
                           &RunScore::energy_error, &RunScore::energy_ratio,
                           &RunScore::rounding_floor, &RunScore::seconds})
    result.*value = std::numeric_limits<double>::quiet_NaN();
  if (!runs.empty()) {
    result.failure_code = runs.front().failure_code;
    result.failure = runs.front().failure;
  }
  return result;
}

}  // namespace clackers::measure
