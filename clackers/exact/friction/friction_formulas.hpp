#pragma once

#include <cmath>
#include <cstddef>

#include "clackers/exact/orbit/formulas.hpp"

namespace clackers::exact {

/// What the closed forms with dry friction have in common, in numbers of any kind: m and k of the mass and its spring, and from one
/// change of stick and slip to the next state(k, s), s seconds after instant(k).
template <class Real, class Formulas>
struct FrictionFormulas {
  Real m, k, omega;

  FrictionFormulas() = default;
  FrictionFormulas(double m_, double k_) : m(m_), k(k_), omega(sqrt(k / m)) {}

  /// At a change only the acceleration jumps.
  LimitsOf<Real> limits(long long change) const {
    const auto& own = static_cast<const Formulas&>(*this);
    return {own.state(change - 1, own.instant(change) - own.instant(change - 1)),
            own.state(change, 0.0), 0.0};
  }
  Real energy(const StatesOf<Real>& x) const {
    return (m * x[0].v * x[0].v + k * x[0].u * x[0].u) * 0.5;
  }
  /// Whether the velocity is 0 for a reason that evaluation does not show.
  bool turns(std::size_t, long long, double) const { return false; }
};

/// n half swings, each less wide by 2 F/k, then rest.
template <class Real>
struct SliderFormulas : FrictionFormulas<Real, SliderFormulas<Real>> {
  using FrictionFormulas<Real, SliderFormulas<Real>>::omega;
  Real x0, F, d, T;
  long long n = 0;

  SliderFormulas() = default;
  SliderFormulas(const SliderParameters& p, long long half_swings)
      : FrictionFormulas<Real, SliderFormulas>(p.m, p.k),
        x0(p.x0),
        F(p.F),
        d(F / this->k),
        T(Real::pi() / omega),
        n(half_swings) {}

  Real rest() const {
    const Real u = (this->k * x0 - Real(2.0 * double(n)) * F) / this->k;
    return n % 2 == 0 ? u : -u;
  }
  Real instant(long long i) const { return i > n ? Real(INFINITY) : Real(double(i)) * T; }
  StatesOf<Real> state(long long i, const Real& s) const {
    if (i == n) return {{{rest(), 0.0, 0.0}}};
    const Real sign = i % 2 == 0 ? 1.0 : -1.0, th = omega * s,
               A = sign * (x0 - Real(2.0 * double(i) + 1.0) * d), wave = A * cos(th);
    return {{{wave + sign * d, -(A * omega * sin(th)), -(wave * omega * omega)}}};
  }
};

/// Stick and slip in turn.
template <class Real>
struct BeltFormulas : FrictionFormulas<Real, BeltFormulas<Real>> {
  using FrictionFormulas<Real, BeltFormulas<Real>>::omega;
  Real V, D, d, stick, slip, T;

  BeltFormulas() = default;
  explicit BeltFormulas(const BeltParameters& p)
      : FrictionFormulas<Real, BeltFormulas>(p.m, p.k),
        V(p.V),
        D((Real(p.limit) - Real(p.kinetic)) / this->k),
        d(Real(p.kinetic) / this->k),
        stick(Real(2.0) * D / V),
        // pi - atan(x) = pi/2 + atan(1/x), without cancellation for small V.
        slip((Real::pi() + Real(2.0) * atan(V / (omega * D))) / omega),
        T(stick + slip) {}

  Real instant(long long i) const {
    const Real start = Real(double(i / 2)) * T;
    return i % 2 == 0 ? start : start + stick;
  }
  StatesOf<Real> state(long long i, const Real& s) const {
    if (i % 2 == 0) return {{{d - D + V * s, V, 0.0}}};
    const Real th = omega * s, c = cos(th), n = sin(th), wave = D * c + V / omega * n;
    return {{{d + wave, V * c - omega * D * n, -(omega * omega * wave)}}};
  }
};

/// Under P cos(W t + phi), from one turning point to the next.
template <class Real>
struct ForcedSliderFormulas : FrictionFormulas<Real, ForcedSliderFormulas<Real>> {
  using FrictionFormulas<Real, ForcedSliderFormulas<Real>>::omega;
  Real F, P, W, T, b, square, tan, H, peak, left;  // b = W/omega; left: (k x0)^2
  Real x0, cos_phi, sin_phi;

  ForcedSliderFormulas() = default;
  explicit ForcedSliderFormulas(const ForcedSliderParameters& p)
      : FrictionFormulas<Real, ForcedSliderFormulas>(p.m, p.k),
        F(p.F),
        P(p.P),
        W(p.W),
        T(Real::pi() / W),
        b(W / omega),
        square(Real(1.0) - b * b) {
    const Real quarter = Real::pi() / (Real(2.0) * b);
    tan = sin(quarter) / cos(quarter);
    H = tan / b;
    peak = P / square;
    left = peak * peak - F * F * H * H;
    x0 = sqrt(left) / this->k;
    cos_phi = this->k * x0 / peak;
    sin_phi = -(F / P) * H * square;
  }

  Real instant(long long i) const { return Real(double(i)) * T; }
  StatesOf<Real> state(long long i, const Real& s) const {
    const Real c = cos(W * s), n = sin(W * s), co = cos(omega * s), si = sin(omega * s);
    const Real driven = peak * (c * cos_phi - n * sin_phi),
               late = peak * (n * cos_phi + c * sin_phi);
    const Real own = F * (co + tan * si), own_late = F * (si - tan * co);
    const Real scale = Real(i % 2 == 0 ? 1.0 : -1.0) / this->k;
    return {{{scale * (F + driven - own), scale * (omega * own_late - W * late),
              scale * (omega * omega * own - W * W * driven)}}};
  }
  bool turns(std::size_t, long long, double t) const { return t == 0.0; }
};

}  // namespace clackers::exact
