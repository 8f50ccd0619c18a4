#pragma once

#include <cstddef>
#include <utility>

#include "clackers/base/block_window.hpp"
#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::measure {

/// One contact at a row of a history: its gap g = b . u - gap, the rate of it, and what free motion would
/// make of that rate.
struct GapRow {
  std::size_t row;  ///< of the history
  double t, g;      ///< [s], [m]
  /// dg/dt before and after the row [m/s]. The history's own where it has velocities, and then
  /// both are the same. Else from the displacements of this row and the one before (after) it, with
  /// free motion between them; NaN at the first (last) row.
  double before, after;
  double acceleration;  ///< d2g/dt2 of free motion [m/s^2]
  double noise;         ///< what a difference of rates may be off by rounding [m/s]
};

/// One contact along a history, at the rows that are used.
class GapHistory {
 public:
  GapHistory(std::size_t size, BlockWindow<GapRow>::Make rows) : rows_(size, 1, std::move(rows)) {}

  std::size_t size() const { return rows_.size(); }
  GapRow operator[](std::size_t i) const { return *rows_[i]; }
  double length(std::size_t i) const { return rows_[i + 1]->t - rows_[i]->t; }
  /// Change of the rate between rows i and i + 1 beyond that of free motion: positive where a
  /// contact accelerates the masses apart [m/s].
  double contact_change(std::size_t i) const;
  /// Bound on |contact_change(i)| where nothing collides: the rule that integrates the
  /// acceleration, and the noise [m/s].
  double uncertainty(std::size_t i) const;

 private:
  mutable BlockWindow<GapRow> rows_;
};

/// Rates below this share of the largest are taken for rest, since those of a resting contact are
/// rounding.
inline constexpr double resting_rate = 1e-12;

/// Every row of a history with velocities, which must outlive it, as must the others. Velocities are taken
/// to be printed with six digits.
GapHistory gap_history_from_velocities(const model::Trajectory& history, const FreeMotion& motion,
                                       const model::Contact<>& contact);

/// From displacements alone: every m-th row, m = 1, 2, 4, ... chosen such that `before` and `after`
/// agree best, which balances printed digits against the length of a step.
GapHistory gap_history_from_displacements(const model::Trajectory& history,
                                          const FreeMotion& motion,
                                          const model::Contact<>& contact);

}  // namespace clackers::measure
