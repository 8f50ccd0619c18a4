#pragma once

#include <cstddef>
#include <vector>

#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::measure {

/// One contact along a history: its gap g = b . u - gap, the rate of it, and what free motion would
/// make of that rate. One entry a row that is used; all vectors have the same length.
struct GapHistory {
  std::vector<std::size_t> row;  ///< of the history
  std::vector<double> t, g;      ///< [s], [m]
  /// dg/dt before and after each row [m/s]. The history's own where it has velocities, and then
  /// both are the same. Else from the displacements of this row and the one before (after) it, with
  /// free motion between them; NaN at the first (last) row.
  std::vector<double> before, after;
  std::vector<double> acceleration;  ///< d2g/dt2 of free motion [m/s^2]
  std::vector<double> noise;         ///< what a difference of rates may be off by rounding [m/s]

  std::size_t size() const { return t.size(); }
  double length(std::size_t i) const { return t[i + 1] - t[i]; }
  /// Change of the rate between rows i and i + 1 beyond that of free motion: positive where a
  /// contact accelerates the masses apart [m/s].
  double contact_change(std::size_t i) const;
  /// Bound on |contact_change(i)| where nothing collides: the rule that integrates the
  /// acceleration, and the noise [m/s].
  double uncertainty(std::size_t i) const;
};

/// Rates below this share of the largest are taken for rest, since those of a resting contact are
/// rounding.
inline constexpr double resting_rate = 1e-12;

/// Every row of a history with velocities. Velocities are taken to be printed with six digits.
GapHistory gap_history_from_velocities(const model::Trajectory& history, const FreeMotion& motion,
                                       const model::Contact<>& contact);

/// From displacements alone: every m-th row, m = 1, 2, 4, ... chosen such that `before` and `after`
/// agree best, which balances printed digits against the length of a step.
GapHistory gap_history_from_displacements(const model::Trajectory& history,
                                          const FreeMotion& motion,
                                          const model::Contact<>& contact);

}  // namespace clackers::measure
