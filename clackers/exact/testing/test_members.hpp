#pragma once

#include <cmath>

#include "clackers/exact/testing/impact_simulator.hpp"
#include "clackers/exact/testing/test_oracle.hpp"

// For tests: the model of a member of a class with 90 digits, from parameters with 90 digits, so
// that derivatives by any of them are differences of simulations.
namespace clackers::exact::testing_oracle {

struct WidePair {
  Real m1, k1, xi1, A, r, eta;
  double odd = 1.0;
  bool exchanged = false;
};

inline WidePair wide(const PairParameters& p) {
  const bool exchanged = p.X < 1.0;
  return {p.m1, p.k1, p.xi1, p.A, p.r, p.eta, exchanged ? std::round(1.0 / p.X) : p.X, exchanged};
}

/// Eq. (9), (12), (13), (15), (17): masses, springs and dashpots from the ratio of the frequencies.
inline RawPair raw_of(const WidePair& p) {
  const Real X = p.exchanged ? 1 / Real(p.odd) : Real(p.odd);
  const int s = std::fmod(p.odd, 4.0) == 1.0 ? 1 : -1;
  const Real omega1 = sqrt(p.k1 / p.m1), m2 = p.m1 / p.r;
  const Real omega2 = omega1 * sqrt((1 - p.xi1 * p.xi1) * X * X + p.xi1 * p.xi1);
  const Real decay = p.xi1 * omega1, u1 = p.exchanged ? s * p.A : p.A, u2 = -s * p.r * u1 / X;
  return {p.m1, m2, p.k1, m2 * omega2 * omega2, 2 * p.m1 * decay, 2 * m2 * decay, p.eta,
          0,    u1, u2,   -decay * u1,          -decay * u2};
}

struct WideExact {
  Real m2, Omega, sigma, A_over_X, r, eta;
  double odd = 1.0;
};

inline RawPair raw_of(const WideExact& p) {
  const int s = std::fmod(p.odd, 4.0) == 1.0 ? 1 : -1;
  const Real m1 = p.r * p.m2, own = p.odd * p.Omega, square = p.sigma * p.sigma;
  const Real u1 = p.odd * p.A_over_X, u2 = -s * p.r * p.A_over_X;
  return {m1,
          p.m2,
          m1 * (p.Omega * p.Omega + square),
          p.m2 * (own * own + square),
          2 * m1 * p.sigma,
          2 * p.m2 * p.sigma,
          p.eta,
          0,
          u1,
          u2,
          -p.sigma * u1,
          -p.sigma * u2};
}

/// The unit mass of Eq. (5) above a stop: a second mass so heavy that 1e-60 of a velocity is what it
/// gets.
inline RawPair raw_of_stop(const Real& xi1, const Real& eta) {
  const Real heavy("1e60");
  return {1, heavy, 1, heavy, 2 * xi1, 0, eta, 0, 1, 0, -xi1, 0};
}

/// A random member with a frequency ratio that a simulation can follow.
inline PairParameters simple_pair(Box& box) {
  PairParameters p{.m1 = box.decades(-2.0, 2.0),
                   .k1 = box.decades(-2.0, 2.0),
                   .xi1 = box.one_in(4)   ? 0.0
                          : box.one_in(4) ? box.decades(-10, -2)
                                          : box.uniform(0.0, 0.7),
                   .A = box.decades(-2.0, 2.0),
                   .X = 2.0 * std::floor(box.uniform(0.0, 5.0)) + 1.0,
                   .r = box.one_in(3) ? box.uniform(2.0, 2.99) : box.decades(-2.0, 0.3),
                   .eta = box.one_in(3) ? 1.0 : box.uniform(0.2, 1.0)};
  if (box.one_in(3)) {
    p.X = 1.0 / p.X;
    p.r = 1.0 / p.r;
  }
  const double damped = std::sqrt(p.k1 / p.m1 * (1.0 - p.xi1 * p.xi1)) * std::min(p.X, 1.0);
  p.t_end = 4.9 * 3.14159 / damped;
  return p;
}

}  // namespace clackers::exact::testing_oracle
