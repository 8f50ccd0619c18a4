#pragma once

#include <vector>

#include "clackers/decks/models/network.hpp"

// For programs without initial displacements: nodes stand where the masses are at the start, displacements
// count from there, and constant forces stand for what the springs hold.
namespace clackers::decks {

inline constexpr double reach = 1000.0;  ///< of the force tables [m]

/// -K u of the start, a mass each [N].
inline Eigen::VectorXd held_forces(const Subject& subject) {
  return -subject.problem.system.stiffness * subject.problem.start.u;
}

/// The gap of a stop for displacements from the start [m].
inline double gap_from_start(const Subject& subject, const Stop& stop) {
  const auto& u = subject.problem.start.u;
  return stop.gap - (stop.upper == ground ? 0.0 : u[stop.upper]) +
         (stop.lower == ground ? 0.0 : u[stop.lower]);
}

}  // namespace clackers::decks
