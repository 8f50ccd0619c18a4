#pragma once

#include "clackers/exact/pair/flight_constants.hpp"
#include "clackers/numerics/simd/factor.hpp"

namespace clackers::exact {

/// The constants of one mass as the kernels want them (see MassConstants).
struct BatchMass {
  numerics::simd::Factor b, v_cos, v_sin;
};

/// The constants of a pair as the kernels want them: no pointers, ready to broadcast.
struct BatchConstants {
  BatchMass slow, fast;             ///< multiples of Omega: 1, and an odd whole number
  bool exchanged = false;           ///< the slow mass is the user's second
  numerics::simd::Factor multiple;  ///< of the fast mass
  numerics::simd::Factor turns;     ///< Omega / pi [1/s]
  double turns_lo = 0.0;            ///< its third part
  numerics::simd::Factor decay;     ///< halvings a second
  numerics::simd::Factor log2_eta;  ///< below 0, or 0 for eta = 1 and eta = 0
  double eta = 1.0;
  double end = 0.0;  ///< [s]
  /// Up to here E and all envelopes are above 2^-960 (see FlightConstants) and, for eta = 0, no
  /// collision is near: every product is normal and the plain path holds.
  double plain_end = 0.0;
  /// |theta / pi| up to which the flight is certain in double precision.
  double certain = 0.0;
  /// Omega end / pi times the larger multiple is so large that the phase needs 159 bits.
  bool long_phase = false;
};

/// Throws InputError unless there are two masses that collide.
BatchConstants batch_constants(const FlightConstants& flight);

}  // namespace clackers::exact
