#pragma once

#include "clackers/exact/elliptic/jacobi.hpp"
#include "clackers/exact/orbit/formulas.hpp"

namespace clackers::exact {

/// Half a swing of a pendulum of any amplitude, from its lowest point and back to it:
/// sin(theta/2) = k sn(w s, k). docs/manual/explanation/derivations/elliptic.md.
struct Swing {
  using Bounded = numerics::Bounded;
  Bounded l, w;  ///< length [m], frequency of small motion [rad/s]
  Modulus modulus;

  /// With the speed at the lowest point [m/s], which must stay below 2 l w.
  static Swing of_speed(const Bounded& l, const Bounded& w, const Bounded& speed) {
    const auto k = speed / (Bounded(2.0) * l * w);
    return {l, w, {k, sqrt((Bounded(1.0) - k) * (Bounded(1.0) + k))}};
  }
  /// From rest at the angle theta0, 0 < theta0 < pi.
  static Swing of_angle(const Bounded& l, const Bounded& w, double theta0) {
    const auto half = Bounded(0.5) * Bounded(theta0);
    return {l, w, {sin(half), cos(half)}};
  }

  Bounded speed() const { return Bounded(2.0) * l * w * modulus.k; }
  Bounded arc() const { return Bounded(2.0) * l * atan(modulus.k / modulus.complement); }
  Bounded duration() const { return Bounded(2.0) * quarter_period(modulus) / w; }
  /// Arc, its rate and its acceleration s seconds after the beginning.
  MassStateOf<Bounded> at(const Bounded& s) const {
    const auto [sn, cn, dn] = jacobi(w * s, modulus);
    const auto sine = modulus.k * sn, twice = Bounded(2.0) * l;
    return {twice * atan(sine / dn), twice * w * modulus.k * cn, -(twice * w * w * sine * dn)};
  }
};

}  // namespace clackers::exact
