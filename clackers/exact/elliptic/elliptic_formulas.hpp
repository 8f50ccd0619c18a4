#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "clackers/exact/elliptic/swing.hpp"

namespace clackers::exact {

/// Half a free period, from the stop and back to it.
template <class Real>
struct StoppedFlight {
  Real start, speed;  ///< at the beginning, which of flight 0 lies before t = 0
  /// 1 - E/E* with the energies of the flight and of the separatrix; E* < 0 for a hardening spring.
  Real margin;
  Modulus<Real> modulus;
  Real frequency, size;  ///< of the argument of the elliptic functions; amplitude
  Real duration() const { return Real(2.0) * quarter_period(modulus) / frequency; }
};

/// An oscillator above a stop at its equilibrium, from rest, in numbers that bound their errors: flights of the speeds
/// V eta^j, which `Formulas` makes by flight(speed, margin), and acceleration(u), largest at strongest().
/// docs/manual/explanation/derivations/elliptic.md.
template <class Real, class Formulas>
struct StoppedFormulas {
  static constexpr std::size_t most_flights = 100'000;
  double m = 1.0, eta = 1.0;
  std::vector<StoppedFlight<Real>>
      flights;  // up to the end, at most so many, and the one after them

  Real instant(long long k) const {
    return k < std::ssize(flights) ? flights[std::size_t(k)].start : Real(INFINITY);
  }
  LimitsOf<Real> limits(long long k) const {
    const Real before = flights[std::size_t(k - 1)].speed, after = Real(eta) * before,
               a = own().acceleration(0.0);
    return {{{{0.0, -before, a}}}, {{{0.0, after, a}}}, Real(m) * (before + after)};
  }
  /// Of an impact, where u = 0.
  Real energy(const StatesOf<Real>& x) const { return Real(0.5) * Real(m) * x[0].v * x[0].v; }
  /// Whether the velocity is 0 for a reason that evaluation does not show.
  bool turns(std::size_t, long long, double t) const { return t == 0.0; }

 protected:
  void follow(StoppedFlight<Real> first, double end) {
    Real start = Real(0.5) * first.duration();
    first.start = -start;
    flights = {std::move(first)};
    // The margin by a sum of positive numbers.
    const Real ratio = eta, lost = (Real(1.0) - ratio) * (Real(1.0) + ratio);
    while (flights.size() <= most_flights) {
      const auto& last = flights.back();
      auto next =
          eta == 1.0 ? last : own().flight(ratio * last.speed, lost + ratio * ratio * last.margin);
      next.start = start;
      start = start + next.duration();
      flights.push_back(std::move(next));
      if ((flights.back().start - Real(end)).is_positive()) return;
    }
  }

 private:
  const Formulas& own() const { return static_cast<const Formulas&>(*this); }
};

template <class Real>
struct PendulumFormulas : StoppedFormulas<Real, PendulumFormulas<Real>> {
  Real l, g, w;

  explicit PendulumFormulas(const PendulumParameters& p) : l(p.l), g(p.g), w(sqrt(g / l)) {
    this->eta = p.eta;
    const auto first = Swing<Real>::of_angle(l, w, p.theta0);
    const Real& complement = first.modulus.complement;
    this->follow(
        {0.0, first.speed(), complement * complement, first.modulus, w, l * Real(p.theta0)}, p.end);
  }
  StoppedFlight<Real> flight(const Real& speed, const Real& margin) const {
    const Swing<Real> swing{l, w, {speed / (Real(2.0) * l * w), sqrt(margin)}};
    return {0.0, speed, margin, swing.modulus, w, swing.arc()};
  }
  Real acceleration(const Real& u) const { return -(g * sin(u / l)); }
  Real strongest() const { return Real(0.5) * Real::pi() * l; }
  StatesOf<Real> state(long long k, const Real& s) const {
    return {{Swing<Real>{l, w, this->flights[std::size_t(k)].modulus}.at(s)}};
  }
};

/// Of the spring: its force at the start over u0.
template <class Number>
Number secant_stiffness(const DuffingParameters& p) {
  return Number(p.k) + Number(p.b) * p.u0 * p.u0;
}

template <class Real>
struct DuffingFormulas : StoppedFormulas<Real, DuffingFormulas<Real>> {
  Real square, cubic;  // k/m, b/m
  bool softens;

  explicit DuffingFormulas(const DuffingParameters& p)
      : square(Real(p.k) / Real(p.m)), cubic(Real(p.b) / Real(p.m)), softens(p.b < 0.0) {
    this->m = p.m;
    this->eta = p.eta;
    const Real root = difference<Real>(
        [&]<class Number>() -> Number { return secant_stiffness<Number>(p) / p.k; });
    this->follow(flight(Real(p.u0) * sqrt(Real(0.5) * square * (Real(1.0) + root)), root * root),
                 p.end);
  }
  /// root = 1 + cubic A^2/square, mean = 1 + cubic A^2/(2 square) with the amplitude A: no differences.
  StoppedFlight<Real> flight(const Real& speed, const Real& margin) const {
    const Real root = sqrt(margin), mean = Real(0.5) * (Real(1.0) + root),
               A = speed / sqrt(square * mean), half = abs(Real(0.5) * cubic * A * A / square);
    const Real &part = softens ? mean : root, &rest = softens ? root : mean;
    return {0.0, speed, margin, {sqrt(half / part), sqrt(rest / part)}, sqrt(square * part), A};
  }
  Real acceleration(const Real& u) const { return -(square * u + cubic * u * u * u); }
  Real strongest() const {
    return softens ? sqrt(-(square / (Real(3.0) * cubic))) : Real(INFINITY);
  }
  StatesOf<Real> state(long long k, const Real& s) const {
    const auto& now = this->flights[std::size_t(k)];
    const auto [sn, cn, dn] = jacobi<Real>(now.frequency * s, now.modulus);
    const Real rate = now.size * now.frequency, c = now.modulus.complement;
    const Real u = softens ? now.size * sn : c * now.size * sn / dn,
               v = softens ? rate * cn * dn : c * rate * cn / (dn * dn);
    return {{{u, v, acceleration(u)}}};
  }
};

/// The modulus near `guess` with k/K(k) = ratio, by chords; enclosed by the signs of the difference on both sides. All
/// numbers where these leave it open.
template <class Real>
Real modulus_of_ratio(const Real& ratio, double guess) {
  const auto rest_at = [&](const Real& k) {
    return k / quarter_period(Modulus<Real>::of(k)) - ratio;
  };
  const Real step = 1e-5 * guess,
             slope = middle((rest_at(guess + step) - rest_at(guess - step)) / (step + step));
  Real k = guess, rest = rest_at(k), size = upper(rest), before;
  do {
    before = size;
    k = middle(k - rest / slope);
    rest = rest_at(k);
    size = upper(rest);
  } while ((before - Real(2.0) * size).is_positive());
  Real reach = middle(Real(2.0) * size / slope);
  for (int i = 0; i < 20; ++i, reach = reach + reach)
    if (rest_at(k + reach).is_positive() && (-rest_at(k - reach)).is_positive())
      return widened(k, reach);
  return widened(k, 1.0);
}

/// Two pendula that meet at their lowest points.
template <class Real>
struct TwoPendulaFormulas {
  bool together;
  Real m1;
  std::array<Swing<Real>, 2> swings;
  Real T1, T2;  // of pendulum 2 while pendulum 1 rests: 0 together

  /// With about the modulus of pendulum 2.
  TwoPendulaFormulas(const TwoPendulaParameters& p, double guess) : together(true), m1(p.m1) {
    const Real l1 = p.l1;
    auto& [first, second] = swings;
    first = Swing<Real>::of_angle(l1, sqrt(Real(p.g) / l1), p.theta1);
    const Real K1 = quarter_period(first.modulus);
    second.modulus =
        Modulus<Real>::of(modulus_of_ratio<Real>(m1 / Real(p.m2) * first.modulus.k / K1, guess));
    const Real stretch = quarter_period(second.modulus) / K1;
    second.w = first.w * stretch;
    second.l = l1 / (stretch * stretch);
    T1 = first.duration();
  }
  explicit TwoPendulaFormulas(const PendulumCradleParameters& p) : together(false), m1(1.0) {
    const Real l1 = p.l1, l2 = p.l2, g = p.g;
    auto& [first, second] = swings;
    first = Swing<Real>::of_angle(l1, sqrt(g / l1), p.theta1);
    const Real margin = difference<Real>([&]<class Number>() -> Number {
      const Number k1 = sin(Number(0.5 * p.theta1));
      return Number(1.0) - k1 * k1 * p.l1 / p.l2;
    });
    second = {l2, sqrt(g / l2), {first.modulus.k * sqrt(l1 / l2), sqrt(margin)}};
    T1 = first.duration();
    T2 = second.duration();
  }

  Real instant(long long k) const {
    const Real half = Real(0.5) * T1;
    if (together) return Real(double(k)) * T1 - half;
    return Real(double((k + 1) / 2)) * T1 + Real(double(k / 2)) * T2 - half;
  }
  StatesOf<Real> state(long long k, const Real& s) const {
    StatesOf<Real> now{};
    if (together || k % 2 == 0) now[0] = swings[0].at(s);
    if (together || k % 2 == 1) {
      const auto [u, v, a] = swings[1].at(s);
      now[1] = {-u, -v, -a};
    }
    return now;
  }
  LimitsOf<Real> limits(long long k) const {
    const Real v1 = swings[0].speed(), v2 = swings[1].speed();
    LimitsOf<Real> limit{};
    limit.impulse = m1 * (together ? Real(2.0) * v1 : v1);
    if (together) {
      limit.before[0].v = -v1, limit.after[0].v = v1;
      limit.before[1].v = v2, limit.after[1].v = -v2;
    } else if (k % 2 == 1) {
      limit.before[0].v = limit.after[1].v = -v1;
    } else {
      limit.before[1].v = limit.after[0].v = v1;
    }
    return limit;
  }
  /// Of an impact, where u = 0. Masses together have opposite momenta, others are equal.
  Real energy(const StatesOf<Real>&) const {
    const Real v1 = swings[0].speed(), v2 = swings[1].speed();
    return Real(0.5) * m1 * (together ? v1 * (v1 + v2) : v1 * v1);
  }
  bool turns(std::size_t, long long, double t) const { return t == 0.0; }
};

}  // namespace clackers::exact
