#pragma once

#include "clackers/exact/orbit/formulas.hpp"

namespace clackers::exact {

/// Straight chords of one length, all at the same distance from the center, each turned against the one before. With
/// the velocity V of the first chord as a complex number, L = x0 vy - y0 vx and S = sqrt(R^2 V V* - L^2),
///
///     chord k has the velocity V w^k with w = ((L + i S)/(R |V|))^2, and the position (tau - i L/|V|^2) V w^k,
///     tau seconds after its middle, -S/|V|^2 <= tau <= S/|V|^2
///
/// docs/manual/explanation/derivations/resting.md.
template <class Real>
struct CircleFormulas {
  struct Complex {
    Real x, y;
    friend Complex operator*(const Complex& a, const Complex& b) {
      return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
    }
  };
  Real x, y, R, square, L, S, begins,
      half;  // square = |V|^2; the middle of chord 0 and half a chord [s]
  Complex V, turn;

  CircleFormulas() = default;
  explicit CircleFormulas(const CircleBilliardParameters& p) : x(p.x0), y(p.y0), R(p.R) {
    V = {p.vx, p.vy};
    square = V.x * V.x + V.y * V.y;
    L = x * V.y - y * V.x;
    S = sqrt(R * R * square - L * L);
    begins = -((x * V.x + y * V.y) / square);
    half = S / square;
    turn = {Real(2.0) * L * L / (R * R * square) - 1.0, Real(2.0) * L * S / (R * R * square)};
  }

  Real instant(long long k) const {
    return k == 0 ? Real(0.0) : begins + Real(2.0 * double(k) - 1.0) * half;
  }
  StatesOf<Real> state(long long k, const Real& s) const {
    if (k > 0) return on_chord(k, s - half);
    return {{{x + V.x * s, V.x, 0.0}, {y + V.y * s, V.y, 0.0}}};
  }
  LimitsOf<Real> limits(long long k) const {
    return {on_chord(k - 1, half), on_chord(k, -half), Real(2.0) * S / R};
  }
  Real energy(const StatesOf<Real>&) const { return square * 0.5; }
  bool turns(std::size_t, long long, double) const { return false; }

 private:
  StatesOf<Real> on_chord(long long k, const Real& tau) const {
    Complex now = V;
    for (auto power = turn; k > 0; k /= 2, power = power * power)
      if (k % 2 == 1) now = now * power;
    const Real off = L / square;
    return {{{tau * now.x + off * now.y, now.x, 0.0}, {tau * now.y - off * now.x, now.y, 0.0}}};
  }
};

}  // namespace clackers::exact
