#include "clackers/exact/batch/batch_flight.hpp"

#include <cmath>

#include "clackers/numerics/exp2.hpp"
#include "clackers/numerics/sincospi.hpp"

namespace clackers::exact {

using numerics::DoubleDouble;

FlightPhase flight_phase(const FlightConstants& c, const DoubleDouble& t) {
  const auto turns = c.turns * t.hi;
  double k = numerics::nearest_whole(turns.hi);
  // k <= 2^50 + 1, so the difference is exact.
  const auto top = numerics::two_sum(turns.hi - k, turns.mid);
  auto y = numerics::quick_two_sum(top.hi, top.lo + turns.lo);
  if (t.lo != 0.0) y = y + DoubleDouble{c.turns.hi, c.turns.mid} * t.lo;
  // The parts below turns.hi may carry y over the edge of [-1/2, 1/2).
  if (y.hi > 0.5 || (y.hi == 0.5 && y.lo >= 0.0)) {
    k += 1.0;
    y = y + DoubleDouble{-1.0, 0.0};
  } else if (y.hi < -0.5 || (y.hi == -0.5 && y.lo < 0.0)) {
    k -= 1.0;
    y = y + DoubleDouble{1.0, 0.0};
  }
  return {k, y};
}

FlightPhase flight_phase(const FlightConstants& c, double t, model::Side side) {
  auto phase = flight_phase(c, DoubleDouble{t, 0.0});
  const double natural = phase.flight, y = phase.half_turns.hi;
  // Half an ulp of t is at most 2^-53 Omega t / pi < 2^-53 (k + 1) half turns; twice that filters.
  if (0.5 - std::abs(y) > (natural + 1.0) * 0x1p-52) return phase;
  const double k = y > 0.0 ? natural + 1.0 : natural;
  if (k < 1.0 || numerics::nearest_double(c.period * (k - 0.5)).nearest != t) return phase;
  phase.flight = side == model::Side::left ? k - 1.0 : k;
  phase.half_turns = phase.half_turns + DoubleDouble{natural - phase.flight, 0.0};
  return phase;
}

PairState pair_state(const FlightConstants& c, const DoubleDouble& t, const FlightPhase& phase) {
  if (c.eta == 0.0 && phase.flight > 0.0) return {};
  const auto halvings = c.log2_eta * phase.flight - c.decay * t;
  // Below 2^-4000 every product with a constant is nearer to 0 than to the smallest subnormal.
  if (halvings.hi < -4000.0) return {};
  const auto [e, exponent] = numerics::exp2(halvings);
  double u[2], v[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& mass = c.masses[i];
    const auto [sine, cosine] = numerics::sincospi(phase.half_turns * mass.multiple);
    const auto ec = e * cosine, es = e * sine;
    u[i] = numerics::scale((mass.b * ec).hi, exponent);
    v[i] = numerics::scale((mass.v_cos * ec + mass.v_sin * es).hi, exponent);
  }
  return {u[0], u[1], v[0], v[1]};
}

}  // namespace clackers::exact
