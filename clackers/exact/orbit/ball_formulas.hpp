#pragma once

#include <cstddef>

#include "clackers/exact/orbit/formulas.hpp"

namespace clackers::exact {

/// Flight k begins with impact k up to `last`; then comes rest. Closed sums of geometric series:
/// docs/manual/explanation/derivations/resting.md.
template <class Real>
struct BallFormulas {
  BallParameters ball;
  long long last = 0;
  Real V, first, once, unit;  // once = 1 - eta; t_k = first + (eta - eta^k) unit

  BallFormulas() = default;
  BallFormulas(const BallParameters& ball_, long long last_)
      : ball(ball_), last(last_), once(Real(1.0) - Real(ball.eta)) {
    const Real v0 = ball.v0, g = ball.g;
    V = sqrt(v0 * v0 + Real(2.0) * g * Real(ball.h0));
    first = ball.v0 < 0.0 ? Real(2.0) * Real(ball.h0) / (V - v0) : (v0 + V) / g;
    unit = Real(2.0) * V / (g * once);
  }

  long long last_flight() const { return last + 1; }
  /// What impact k is followed by: flight k, or rest.
  long long following(long long k) const { return ball.eta > 0.0 ? k : last + 1; }
  /// Of eta; 0 after the last.
  Real power(long long k) const {
    if (k > last) return 0.0;
    Real result = 1.0, square = ball.eta;
    for (; k > 0; k /= 2, square = square * square)
      if (k % 2 == 1) result = result * square;
    return result;
  }
  Real rest() const { return first + unit * Real(ball.eta); }
  Real instant(long long k) const {
    if (k == 0) return 0.0;
    if (k > last) return rest();
    return first + unit * (Real(ball.eta) - power(k));
  }
  MassStateOf<Real> height(long long k, const Real& s) const {
    const Real a = k <= last ? -ball.g : 0.0, v = k == 0 ? Real(ball.v0) : power(k) * V;
    return {(k == 0 ? Real(ball.h0) : Real(0.0)) + s * (v + Real(0.5) * a * s), v + a * s, a};
  }
  StatesOf<Real> state(long long k, const Real& s) const { return {{height(k, s)}}; }
  LimitsOf<Real> limits(long long k) const {
    const Real speed = power(k - 1) * V;
    LimitsOf<Real> limit;
    limit.before[0] = {0.0, -speed, -ball.g};
    limit.after[0] = height(following(k), 0.0);
    limit.impulse = (Real(1.0) + Real(ball.eta)) * speed;
    return limit;
  }
  /// Of an impact, where the height is 0.
  Real energy(const StatesOf<Real>& x) const { return x[0].v * x[0].v * 0.5; }
  bool turns(std::size_t, long long, double) const { return false; }
};

}  // namespace clackers::exact
