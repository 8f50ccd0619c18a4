#pragma once

#include "clackers/exact/pair/sampling.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/numerics/exp2.hpp"

namespace clackers::exact {

/// Flight k, counted as a double to avoid conversions, and theta / pi in it.
struct Phase {
  double flight = 0.0;
  numerics::DoubleDouble theta_over_pi;
};

/// The flight that truly holds at t >= 0, whether anything collides or not; theta / pi lies in
/// [-1/2, 1/2], with an error below 2^-100.
Phase natural_phase(const FlightConstants& c, double t);

/// The same, but where t is the double nearest to an impact, the flight that `side` means. Without
/// impacts the flight is 0 and theta / pi lies in [-1, 1].
Phase phase_at(const FlightConstants& c, double t, model::Side side);

/// t_k [s] of impact k = 1, 2, ...
numerics::Neighbour impact_instant(const FlightConstants& c, double k);

/// 2^halvings; 0 below 2^-4000, where every product with a constant (all below 1e300) is nearer to
/// 0 than to the smallest subnormal.
numerics::Scaled power(const numerics::DoubleDouble& halvings);

/// Throws InputError (beyond-last-impact).
[[noreturn]] void refuse_impact(const FlightConstants& c, long long index, long long count);

}  // namespace clackers::exact
