#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "clackers/diagnose/observation.hpp"
#include "clackers/model/impact_problem.hpp"

namespace clackers::diagnose {

/// How one impact of a history was located, read from the rows around it alone: free motion of the
/// true system is followed forward from the last open row before it and backward from the first
/// open row after it, each to where the gap closes. An impact applied at the instant of contact has
/// one such instant; one applied d seconds late has gone past it and needs d / eta to come back.
/// What happened before does not enter.
struct LocatedImpact {
  double t = 0.0;        ///< where the flight before it closes the gap [s]
  int contact = 0;       ///< row of ImpactProblem::contacts
  double closing = 0.0;  ///< closing speed there [m/s], positive
  double opening = 0.0;  ///< speed with which the flight after it opens the gap [m/s], positive
  /// Opening over closing, and its half width: of the flights on both sides, and of a late impact. Of
  /// rows between steps also what the flights beside them lack: a row interpolated across the impact
  /// lies on neither.
  double restitution = 0.0, restitution_error = 0.0;
  /// Part of the change of momentum that impulses along the contacts cannot give: |p - G^T J| over
  /// |p|, p = M (v(+) - v(-)), in the norm of the kinetic energy. 0 for one mass.
  double momentum_defect = 0.0;
  double delay = 0.0;        ///< of the impact [s]; negative where it came too early
  double delay_steps = 0.0;  ///< the same in steps of the history, or in rows of one of a tolerance
  double gap = 0.0;          ///< at which it acts [m], where both flights meet; negative where late
  double duration = 0.0;     ///< from closing to opening [s]
  /// Mean speed of the gap at the closed rows, over that at which it closes, or opens where it
  /// does: 2/pi in a spring, 1 where masses fly on until an impulse turns them. NaN for no such row.
  double closed_speed = std::numeric_limits<double>::quiet_NaN();
  /// Distance of the state after from what the impact law makes of the state before, both at t,
  /// in velocity: |w du| + |dv| over the closing speed, w the highest frequency.
  double defect = 0.0;
  /// Part of (row after - impact) M^-1 C (v(+) - v(-)) that the velocity after it has too much: what
  /// stays of the acceleration before the impact where a step after it still uses that, 1/2 for the
  /// trapezoidal rule. NaN without damping.
  double stale_share = std::numeric_limits<double>::quiet_NaN();
};

/// The impacts of one history that could be located.
struct LocatedImpacts {
  double step = 0.0;  ///< [s]
  /// What the integrator makes of a flight between two rows far from impacts, as a time: the median
  /// over such rows of |gap error| over the median closing speed [s].
  double uncertainty = 0.0;
  double flight_defect = 0.0;  ///< the same as a defect, over the length of the flight [1/s]
  std::vector<LocatedImpact> impacts;
  /// Those after which the masses stay together, by time, contact and closing speed; the flight after
  /// some of them is among `impacts` as well.
  std::vector<LocatedImpact> sticking;

  double rms_delay() const;
  double rms_defect() const;
  /// Whether delays are more than what flights between rows, and roundings, show.
  bool is_resolved() const {
    return !impacts.empty() && rms_delay() > std::max(5.0 * uncertainty, 1e-7 * step);
  }
  /// Whether masses fly on through the closed rows until one step turns them, as in no spring.
  bool is_rigid() const;
};

/// Empty without velocities, and where rows are too far apart to hold single flights. `by_tolerance`:
/// the step of the history is a tolerance.
LocatedImpacts locate_impacts(const Observation& seen, const model::ImpactProblem<>& problem,
                              bool by_tolerance = false);

/// One gap at which all impacts of some histories act.
struct CommonGap {
  double value = 0.0, spread = 0.0;  ///< [m]
  bool is_told = false;              ///< their delays differ, as speeds do: it is no common delay
};

/// Nothing where gaps differ by a tenth, and of one history where its delays do not differ by more.
std::optional<CommonGap> common_gap(std::span<const LocatedImpacts> files);

}  // namespace clackers::diagnose
