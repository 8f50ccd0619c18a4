#include "clackers/exact/batch/batch_constants.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::exact {

using numerics::DoubleDouble;
using numerics::simd::Factor;

BatchConstants batch_constants(const FlightConstants& flight) {
  if (flight.masses.size() != 2 || !flight.collides)
    throw InputError("batch: allowed: the motion of two masses that collide.", "out-of-range");
  BatchConstants c;
  c.exchanged = flight.masses[0].multiple > flight.masses[1].multiple;
  const auto& slow = flight.masses[c.exchanged ? 1 : 0];
  const auto& fast = flight.masses[c.exchanged ? 0 : 1];
  c.slow = {Factor(slow.b), Factor(slow.v_cos), Factor(slow.v_sin)};
  c.fast = {Factor(fast.b), Factor(fast.v_cos), Factor(fast.v_sin)};
  c.multiple = Factor(fast.multiple);
  c.turns = Factor(DoubleDouble{flight.turns.hi, flight.turns.mid});
  c.turns_lo = flight.turns.lo;
  c.decay = Factor(flight.decay);
  c.log2_eta = Factor(flight.log2_eta);
  c.eta = flight.eta;
  c.end = flight.end;

  const double half_periods = flight.turns.hi * flight.end;
  // E >= 2^(-decay t + log2_eta (turns t + 1/2)); in a motion without loss it is 1 for ever.
  const double halvings = flight.decay.hi - flight.log2_eta.hi * flight.turns.hi;
  // Below the normal numbers the sign of a displacement no longer tells the flight.
  double smallest = 1.0;
  for (const auto& mass : flight.masses)
    smallest = std::min({smallest, mass.u_envelope, mass.v_envelope});
  // ilogb rounds a logarithm down, in a tenth of its time.
  const double module = 959.0 + std::ilogb(smallest) + 0.5 * flight.log2_eta.hi;
  c.plain_end = flight.end;
  if (halvings * flight.end > module) c.plain_end = std::max(0.0, module / halvings);
  if (flight.eta == 0.0) c.plain_end = std::min(c.plain_end, 0.499 * flight.period.hi);
  // Half an ulp of t is at most 2^-53 (half_periods + 1) half turns, the phase is better than that.
  c.certain = 0.5 - std::max(0x1p-30, (half_periods + 2.0) * 0x1p-51);
  // A phase of two doubles is off by 2^-105 half_periods: at most 2^-57 in the sine.
  c.long_phase = half_periods * fast.multiple > 0x1p46;
  return c;
}

}  // namespace clackers::exact
