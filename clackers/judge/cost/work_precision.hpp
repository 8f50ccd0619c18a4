#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "clackers/measure/errors/score.hpp"

// Error against what it cost, by counters that are the same on every machine, or by time.
namespace clackers::judge {

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
double cost(const measure::RunScore& run, Counter counter);

/// One finished run.
struct WorkPoint {
  double step = 0.0, work = 0.0, error = 0.0;
  /// Pareto front: no other run is better in work or error and as good in the other.
  bool on_front = false;
};

/// What a step of this size may cost and err by: the worst run of a level, see worst().
struct WorkLevel {
  double step = 0.0;   ///< nominal [s]
  double work = 0.0;   ///< largest of the runs that finished
  double error = 0.0;  ///< largest of the runs that finished; NaN where none did
  int failed = 0;      ///< runs that did not finish, or whose error is not finite
};

/// A method's cost and displacement error over its ladder.
struct WorkCurve {
  std::vector<WorkPoint> runs;      ///< ascending by work, then by error
  std::vector<WorkLevel> envelope;  ///< as the levels of the ladder, coarsest first
};

/// The curve of a ladder; a run whose error is not finite has failed. Throws InputError for a
/// negative error.
WorkCurve work_curve(const measure::Ladder& ladder, Counter counter);

/// The least work of a level such that, at it and at all finer ones, no run fails and no error
/// exceeds `error`; nothing where the finest level does not reach it. Costs are not interpolated
/// between levels. Throws InputError unless error > 0.
std::optional<double> work_for(const WorkCurve& curve, double error);

}  // namespace clackers::judge
