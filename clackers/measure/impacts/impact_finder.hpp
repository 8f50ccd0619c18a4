#pragma once

#include <optional>
#include <vector>

#include "clackers/model/impact_problem.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::measure {

/// An impact read from a history that reports none.
struct FoundImpact {
  /// `u`, `v_before` and `v_after` are what free motion makes of the rows around it; `v_after` is
  /// empty and the impulse NaN where the history ends inside the contact.
  model::Impact impact;
  double end = 0.0;  ///< when it was over [s]; later than impact.t for a compliant contact
};

/// The impacts of a history, in order of time, read from its rows, the equation of motion and
/// the contacts; what the history reports is not looked at.
///
/// An impact is where a contact near closure has a force: the relative velocity rises by at least
/// half the closing speed (Newton's law gives 1 + eta of it) beyond what free motion could do
/// between the rows and beyond rounding. So nothing is found in masses that oscillate freely, or
/// pass through each other. A jump between two rows, a jump given as two rows of one time, and a
/// compliant contact over many rows are one impact each, timed at first contact.
///
/// Timing: exact for two rows of one time. Else free motion from the last row before it, followed
/// to contact: local error O(h^5) of the history's own state for rows with velocities, O(h^3)
/// without; the end of the step where it gets no further than that. Without velocities rows are
/// joined to longer steps when printed digits ask for it, and an impact in the first or last of
/// these is not seen.
///
/// Limits: a closing speed below 1e-5 of the velocities, or below what free motion does in a step
/// (about (omega h)^3 / 4 of the velocity of a mass of frequency omega), is not distinguished from
/// free motion. Ten rows a period of the fastest motion at a contact are enough.
///
/// The history has sound sizes and times (require_comparable). Cost: linear in rows and masses.
std::vector<FoundImpact> find_impacts(const model::Trajectory& history,
                                      const model::ImpactProblem<>& problem);

/// The history with both limits of its reported impacts as two rows of one time, or nothing where
/// no row is to be added. A row that stands alone at the time of an impact is replaced by them;
/// two rows stay as they are. Of several impacts at one time the first gives the left limit and the
/// last the right one.
///
/// An impact is used only if its time lies within the history and it carries the displacement and
/// both velocities of every mass, finite. A history with accelerations or without velocities stays
/// as it is, since an impact does not carry accelerations.
std::optional<model::Trajectory> with_jump_limits(const model::Trajectory& history);

}  // namespace clackers::measure
