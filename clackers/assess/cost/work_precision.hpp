#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/assess/errors/score.hpp"

// Error against what it cost, by counters that are the same on every machine, or by time.
namespace clackers::assess {

/// What a run costs.
enum class Counter {
  steps,
  force_evaluations,
  factorizations,
  newton_iterations,
  event_searches,
  seconds  ///< processor time: of one machine on one day
};

inline constexpr Counter all_counters[] = {Counter::steps,          Counter::force_evaluations,
                                           Counter::factorizations, Counter::newton_iterations,
                                           Counter::event_searches, Counter::seconds};

std::string_view to_string(Counter counter);  ///< "force evaluations"
double cost(const RunScore& run, Counter counter);

/// One finished run.
struct WorkPoint {
  double step = 0.0, work = 0.0, error = 0.0;
  bool on_front = false;  ///< no run costs as little and errs as little, one of both strictly less
};

/// The worst of a level: what to expect of a step that was not chosen with luck.
struct WorkLevel {
  double step = 0.0;   ///< nominal [s]
  double work = 0.0;   ///< largest of its runs
  double error = 0.0;  ///< largest of its runs; infinite where a run failed
};

/// A run that failed, with what it had cost until then.
struct WorkFailure {
  double step = 0.0, work = 0.0;
  std::string code;  ///< "diverged", ...
};

/// A method's cost and error over its ladder.
struct WorkCurve {
  Counter counter = Counter::steps;
  std::vector<WorkPoint> runs;      ///< ascending by work, then by error
  std::vector<WorkLevel> envelope;  ///< as the levels of the ladder, coarsest first
  std::vector<WorkFailure> failures;
  bool counts = false;  ///< some run has a cost above 0: a method without Newton's iteration has
                        ///< none of its iterations, and no place on logarithmic axes
};

using ErrorMeasure = std::function<double(const RunScore&)>;

/// The curve of a ladder. `error` is the displacement error where none is given; a run whose error
/// is not finite has failed. Throws InputError for a negative error.
WorkCurve work_curve(const Ladder& ladder, Counter counter, const ErrorMeasure& error = {});

/// The least work of a level from which on, at it and all finer ones, no error exceeds `error`;
/// nothing where the finest level does. Between levels nothing is interpolated. Throws InputError
/// unless error > 0.
std::optional<double> work_for(const WorkCurve& curve, double error);

}  // namespace clackers::assess
