#include "clackers/exact/pair/closed_form.hpp"

#include <cmath>

namespace clackers::exact {

using numerics::DoubleDouble;

Phase natural_phase(const FlightConstants& c, double t) {
  const auto turns = c.turns * t;
  const double start = c.first_impact - 0.5;
  double k = numerics::nearest_whole(turns.hi - start);
  // k <= 2^50 + 1, so the difference is exact.
  const auto top = numerics::two_sum(turns.hi - k, turns.mid);
  auto y = numerics::quick_two_sum(top.hi, top.lo + turns.lo);
  if (start != 0.0) y = y + DoubleDouble{-start, 0.0};
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

numerics::Neighbour impact_instant(const FlightConstants& c, double k) {
  return numerics::nearest_double(c.period * (k - 1.0 + c.first_impact));
}

Phase phase_at(const FlightConstants& c, double t, model::Side side) {
  auto phase = natural_phase(c, t);
  const double natural = phase.flight;
  if (!c.collides) {
    phase.flight = 0.0;
    // An even number of half turns changes nothing, an odd one is a half turn.
    if (std::fmod(natural, 2.0) != 0.0)
      phase.theta_over_pi = phase.theta_over_pi + DoubleDouble{1.0, 0.0};
    return phase;
  }
  // Half an ulp of t is at most 2^-53 Omega t / pi < 2^-53 (k + 1) half turns; twice that filters.
  constexpr double two_to_minus_52 = 0x1p-52;
  const double y = phase.theta_over_pi.hi;
  if (0.5 - std::abs(y) <= (natural + 1.0) * two_to_minus_52) {
    const double k = y > 0.0 ? natural + 1.0 : natural;
    if (k >= 1.0 && impact_instant(c, k).nearest == t) {
      phase.flight = side == model::Side::left ? k - 1.0 : k;
      phase.theta_over_pi = phase.theta_over_pi + DoubleDouble{natural - phase.flight, 0.0};
    }
  }
  return phase;
}

numerics::Scaled power(const DoubleDouble& halvings) {
  if (halvings.hi < -4000.0) return {};
  return numerics::exp2(halvings);
}

}  // namespace clackers::exact
