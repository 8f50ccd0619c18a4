#pragma once

#include <algorithm>
#include <cmath>
#include <complex>

#include "clackers/numerics/modes/modal_flight.hpp"

namespace clackers::numerics {

/// The response, 0 at t = 0, of a mode to the force e^(i W t) at or near its own frequency, where the steady one has
/// no bound: (e^(i W t) - e^(lambda t))/((i W - lambda)(i W - conj lambda)), lambda = -sigma + i w, whose parts
/// cancel. With mu and d half the sum and the difference of i W and lambda, it is
///
///     y = scale E,    E = e^(mu t) sinh(d t)/d,    E' = mu E + R,    R = e^(mu t) cosh(d t),    R' = mu R + d^2 E
///
/// and at resonance E = t e^(i W t). For sigma >= 0 |E| <= min(t, 1/|d|) and |R| <= 1.
struct Beat {
  using Complex = std::complex<double>;
  Complex scale, mu, d;

  Beat(const Mode& mode, double frequency)
      : scale(1.0 / Complex(mode.sigma, frequency + mode.w)),
        mu(0.5 * Complex(-mode.sigma, frequency + mode.w)),
        d(0.5 * Complex(mode.sigma, frequency - mode.w)) {}

  struct State {
    Complex e, r;
  };
  State at(double t) const {
    const Complex x = d * t;
    if (std::abs(x) > 1.0) {
      const Complex forced = std::exp((mu + d) * t), free = std::exp((mu - d) * t);
      return {(forced - free) / (2.0 * d), 0.5 * (forced + free)};
    }
    const Complex turn = std::exp(mu * t);
    return {turn * (d == 0.0 ? Complex(t) : std::sinh(x) / d), turn * std::cosh(x)};
  }
  /// A bound on |E| up to t.
  double most(double t) const { return std::min(t, 1.0 / std::abs(d)); }
};

/// e E + r R of a beat.
struct BeatForm {
  std::complex<double> e, r;

  double value(const Beat::State& now) const { return (e * now.e + r * now.r).real(); }
  /// On the size of it where |E| is at most this.
  double bound(double most) const { return std::abs(e) * most + std::abs(r); }

  BeatForm derivative(const Beat& beat) const {
    return {beat.mu * e + beat.d * beat.d * r, beat.mu * r + e};
  }
};

}  // namespace clackers::numerics
