#pragma once

#include <cmath>
#include <type_traits>

#include "clackers/exact/orbit/formulas.hpp"
#include "clackers/numerics/wide.hpp"

namespace clackers::exact {

/// The number of a formula that takes a difference of nearly equal numbers: formula.operator()<Number>() in balls, or in
/// 256 bits that are narrowed to 64.
template <class Real>
Real difference(const auto& formula) {
  if constexpr (std::is_same_v<Real, numerics::Bounded>)
    return numerics::narrowed(formula.template operator()<numerics::Wide>());
  else
    return formula.template operator()<Real>();
}

/// The modulus k of elliptic functions with its complement: k^2 + k'^2 = 1, 0 <= k < 1. Both are given, since
/// either loses digits beside the other. Here and below in numbers that bound their errors: numerics::Bounded or
/// certified::Ball.
template <class Real>
struct Modulus {
  Real k, complement;
  /// Of a k that is not close to 1.
  static Modulus of(const Real& k) { return {k, sqrt((Real(1.0) - k) * (Real(1.0) + k))}; }
};

/// The complete integral of the first kind, pi/2 over the arithmetic-geometric mean of 1 and k'.
template <class Real>
Real quarter_period(const Modulus<Real>& modulus) {
  return Real::pi() / (Real(2.0) * agm(Real(1.0), modulus.complement));
}

template <class Real>
struct Jacobi {
  Real sn, cn, dn;
};
/// Jacobi's functions of a real argument, by Landen's descending transformation: with k1 = k^2/(1 + k')^2
/// and s1, c1, d1 those of u/(1 + k1), k1
///
///     sn = (1 + k1) s1/(1 + k1 s1^2),  cn = c1 d1/(1 + k1 s1^2),  dn = (1 - k1 s1^2)/(1 + k1 s1^2)
///
/// until the modulus has no effect. Source: M. Abramowitz, I. A. Stegun (1964), 16.12, 16.13. Of a modulus whose error
/// leaves everything open, 0 with an error of 1.
template <class Real>
Jacobi<Real> jacobi(const Real& u, const Modulus<Real>& modulus) {
  const Real one = 1.0, square = modulus.k * modulus.k;
  if (!((Real(2.0) - square).is_positive() && modulus.complement.is_positive())) {
    const Real open = widened(Real(0.0), one);
    return {open, open, open};
  }
  if (square.is_negligible()) {
    // To first order in k^2: sn = sin u - k^2/4 (u - sin u cos u) cos u, dn = 1 - k^2/2 sin^2 u.
    const Real error = square * (one + abs(u));
    return {widened(sin(u), error), widened(cos(u), error), widened(one, error)};
  }
  const Real sum = one + modulus.complement, k1 = square / (sum * sum);
  const auto low = jacobi<Real>(u / (one + k1), {k1, Real(2.0) * sqrt(modulus.complement) / sum});
  const Real part = k1 * low.sn * low.sn, below = one + part;
  return {(one + k1) * low.sn / below, low.cn * low.dn / below, (one - part) / below};
}

/// Half a swing of a pendulum of any amplitude, from its lowest point and back to it:
/// sin(theta/2) = k sn(w s, k). docs/manual/explanation/derivations/elliptic.md.
template <class Real>
struct Swing {
  Real l, w;  ///< length [m], frequency of small motion [rad/s]
  Modulus<Real> modulus;

  /// From rest at the angle theta0, 0 < theta0 < pi.
  static Swing of_angle(const Real& l, const Real& w, double theta0) {
    const Real half = 0.5 * theta0;  // exactly
    return {l, w, {sin(half), cos(half)}};
  }

  Real speed() const { return Real(2.0) * l * w * modulus.k; }
  Real arc() const { return Real(2.0) * l * atan(modulus.k / modulus.complement); }
  Real duration() const { return Real(2.0) * quarter_period(modulus) / w; }
  /// Arc, its rate and its acceleration s seconds after the beginning.
  MassStateOf<Real> at(const Real& s) const {
    const auto [sn, cn, dn] = jacobi<Real>(w * s, modulus);
    const Real sine = modulus.k * sn, twice = Real(2.0) * l;
    return {twice * atan(sine / dn), twice * w * modulus.k * cn, -(twice * w * w * sine * dn)};
  }
};

}  // namespace clackers::exact
