#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clackers/model/run.hpp"

namespace clackers::measure {

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
  std::string failure_code;  ///< of a run that failed: "diverged", "newton-failed", ...
  std::string failure;       ///< and its sentence
  /// Largest over masses and output times of |error in u| over its peak, see model::Motion.
  double u_error = 0.0;
  double u_error_absolute = 0.0;  ///< the same, not divided [m]
  /// L1 over time by the rule of VelocityError, over the run's length and the scale of v; largest
  /// over masses.
  double v_error = 0.0;
  /// Largest over output times of |E - E*| over the largest E* of the run, E kinetic energy and that
  /// of the structure (not of a contact spring). Where impacts take energy (eta < 1) it does not tend to zero with
  /// the step: between an impact and that of the run the two are on either side of the jump.
  double energy_error = 0.0;
  double energy_ratio = 1.0;  ///< E / E* at the last state; NaN where E* is 0
  /// Below it errors show nothing: the larger of an estimate of rounding for this many steps and
  /// of the reference's own error bound, relative as u_error and v_error are.
  double rounding_floor = 0.0;
  std::optional<ImpactScore> impacts;  ///< empty: the run does not report impacts
  model::Work work;
  double seconds = 0.0;  ///< processor time of the run alone
};

/// Neighbouring steps around one nominal step.
struct ScoreLevel {
  double step = 0.0;           ///< nominal h [s]
  std::vector<RunScore> runs;  ///< the steps of a level, coarsest first
};

/// Levels of one method, coarsest first.
using Ladder = std::vector<ScoreLevel>;

/// The worst run of a level, the one rule for all tables, figures and fits. Over the runs that
/// finished: the largest of each error, each floor, each count of work and the time, the energy
/// ratio farthest from 1 in either direction, and the impacts with the most missed and extra ones,
/// with the largest of their time errors. An error that is not a number counts as largest. A failed
/// run counts nowhere; where all failed, errors, energy ratio, floor and time are NaN, the work is
/// that of no run, and the failure is the first run's. The step is the first run's.
RunScore worst(std::span<const RunScore> runs);

}  // namespace clackers::measure
