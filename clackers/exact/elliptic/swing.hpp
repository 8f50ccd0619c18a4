#pragma once

#include "clackers/exact/elliptic/jacobi.hpp"
#include "clackers/exact/orbit/formulas.hpp"

namespace clackers::exact {

/// Half a swing of a pendulum of any amplitude, from its lowest point and back to it:
/// sin(theta/2) = k sn(w s, k). docs/manual/explanation/derivations/elliptic.md.
template <class Real>
struct Swing {
  Real l, w;  ///< length [m], frequency of small motion [rad/s]
  Modulus<Real> modulus;

  /// With the speed at the lowest point [m/s], which must stay below 2 l w.
  static Swing of_speed(const Real& l, const Real& w, const Real& speed) {
    const Real k = speed / (Real(2.0) * l * w);
    return {l, w, {k, sqrt((Real(1.0) - k) * (Real(1.0) + k))}};
  }
  /// From rest at the angle theta0, 0 < theta0 < pi.
  static Swing of_angle(const Real& l, const Real& w, double theta0) {
    const Real half = Real(0.5) * Real(theta0);
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
