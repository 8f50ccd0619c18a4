#pragma once

#include "clackers/exact/pair/flight_constants.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::exact {

/// Displacements [m] and velocities [m/s] of a pair at one time.
struct PairState {
  double u1 = 0.0, u2 = 0.0, v1 = 0.0, v2 = 0.0;
};

/// Flight k >= 0, counted as a double, and theta / pi in it.
struct FlightPhase {
  double flight = 0.0;
  numerics::DoubleDouble half_turns;
};

/// The phase at the real number t.hi + t.lo >= 0: theta / pi in [-1/2, 1/2).
FlightPhase flight_phase(const FlightConstants& c, const numerics::DoubleDouble& t);

/// The phase at the double t; where t is the double nearest to a collision, `side` chooses.
FlightPhase flight_phase(const FlightConstants& c, double t, model::Side side);

/// The state at t.hi + t.lo, which has this phase, to 0.51 units of 2^-52 of each envelope and a
/// subnormal spacing (see ClosedForm::error_bound). For the few times that kernels leave out.
PairState pair_state(const FlightConstants& c, const numerics::DoubleDouble& t,
                     const FlightPhase& phase);

}  // namespace clackers::exact
