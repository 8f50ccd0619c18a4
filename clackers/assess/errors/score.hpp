#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clackers/model/run.hpp"

namespace clackers::assess {

/// Impacts of a run against the true ones, matched in order, nearest within a quarter of the time
/// between true neighbours. One compliant contact, or impacts in adjacent steps, are one impact,
/// timed at its first contact.
struct ImpactScore {
  long long expected = 0, found = 0, matched = 0, missed = 0, extra = 0;
  double worst_time_error = 0.0;  ///< over the matched ones [s]
  double rounding_floor = 0.0;    ///< of worst_time_error, estimated [s]
};

/// One run against the reference.
struct RunScore {
  double step = 0.0;  ///< h [s]
  bool finished = false;
  std::string failure_code;       ///< of a run that failed: "diverged", "newton-failed", ...
  std::string failure;            ///< and its sentence
  double u_error = 0.0;           ///< max over masses and own times of |error| / envelope at t = 0
  double u_error_absolute = 0.0;  ///< the same, not divided [m]
  double v_error = 0.0;  ///< L1 over time by the trapezoidal rule, over the run's length and the
                         ///< initial envelope; max over masses; both limits at reported impacts
                         ///< (VelocityError says how)
  double energy_error = 0.0;           ///< max over own times of |E - E true| / E true at t = 0
  double energy_ratio = 1.0;           ///< E / E true at the last state; NaN where E true is 0
  double rounding_floor = 0.0;         ///< of u_error, estimated for this many steps
  std::optional<ImpactScore> impacts;  ///< empty: the run does not report impacts
  model::Work work;
  double seconds = 0.0;  ///< processor time of the run without its judgement
};

/// Neighbouring steps around one nominal step.
struct Level {
  double step = 0.0;           ///< nominal h [s]
  std::vector<RunScore> runs;  ///< the steps of a level, coarsest first
};

/// Levels of one method, coarsest first.
using Ladder = std::vector<Level>;

/// The worst run of a level, the one rule for all tables, figures and fits. Over the runs that
/// finished: the largest of each error, each floor, each count of work and the time, the energy
/// ratio farthest from 1 in either direction, and the impacts with the most missed and extra ones,
/// with the largest of their time errors. An error that is not a number counts as largest. A failed
/// run counts nowhere; where all failed, errors, energy ratio, floor and time are NaN, the work is
/// that of no run, and the failure is the first run's. The step is the first run's.
RunScore worst(std::span<const RunScore> runs);

}  // namespace clackers::assess
