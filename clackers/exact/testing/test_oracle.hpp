#pragma once

#include <cmath>
#include <cstdlib>
#include <random>

#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/exact/testing/real.hpp"

// For tests: the closed form by MPFR with 90 digits (300 bits), written as the paper writes it (Eq.
// (22) with its sign function), with nothing taken from the code under test but its parameters.
namespace clackers::exact::testing_oracle {

struct OracleMass {
  Real mass, start, frequency;  ///< frequency: damped
};

struct OracleState {
  Real u[2], v[2], a[2];  ///< of each mass
  Real u_env[2], v_env[2], a_env[2];
};

struct Oracle {
  OracleMass mass[2];
  int dof = 2;
  Real omega, sigma;  ///< of the slow mass; common
  double eta = 1.0;
  bool collides = true;

  Real instant(double k) const { return (2 * Real(k) - 1) * pi() / (2 * omega); }
  long long impacts(double t) const {
    if (!collides) return 0;
    return static_cast<long long>(double(floor(omega * t / pi() + Real(0.5))));
  }
  /// The flight that `side` means at t.
  long long flight(double t, model::Side side) const {
    if (!collides) return 0;
    const auto k = impacts(t);
    for (const auto hit : {k, k + 1})
      if (hit >= 1 && double(instant(double(hit))) == t)
        return side == model::Side::left ? hit - 1 : hit;
    return k;
  }
  Real decay(long long k, const Real& t) const { return pow(Real(eta), k) * exp(-sigma * t); }

  OracleState state(double t, model::Side side) const { return state_in(flight(t, side), t, side); }
  OracleState state_in(long long k, double t, model::Side) const {
    OracleState s;
    const Real e = (k > 0 && eta == 0.0) ? Real(0) : decay(k, t);
    // Each impact turns the motion about: the sgn of Eq. (22).
    const int sign = k % 2 == 0 ? 1 : -1;
    for (int i = 0; i < dof; ++i) {
      const auto& m = mass[i];
      const Real phase = m.frequency * t, square = m.frequency * m.frequency;
      const Real amplitude = sign * m.start * e;
      const Real c = cos(phase), n = sin(phase);
      s.u[i] = amplitude * c;
      s.v[i] = -amplitude * (sigma * c + m.frequency * n);
      s.a[i] = -2 * sigma * s.v[i] - (square + sigma * sigma) * s.u[i];
      s.u_env[i] = abs(amplitude);
      s.v_env[i] = s.u_env[i] * sqrt(square + sigma * sigma);
      s.a_env[i] = s.u_env[i] * (square + sigma * sigma);
    }
    return s;
  }
};

inline int sign_of(double odd) { return std::fmod((odd - 1.0) / 2.0, 2.0) == 0.0 ? 1 : -1; }

inline Oracle oracle_of(const PairParameters& p) {
  Oracle o;
  const Real omega1 = sqrt(Real(p.k1) / Real(p.m1));
  const Real damped = omega1 * sqrt((1 - Real(p.xi1)) * (1 + Real(p.xi1)));
  const double odd = p.X >= 1.0 ? p.X : std::round(1.0 / p.X);
  o.sigma = Real(p.xi1) * omega1;
  o.eta = p.eta;
  const Real m2 = Real(p.m1) / Real(p.r);
  if (p.X >= 1.0) {
    o.omega = damped;
    o.mass[0] = {p.m1, p.A, damped};
    o.mass[1] = {m2, -sign_of(odd) * Real(p.r) * Real(p.A) / Real(odd), damped * Real(odd)};
  } else {
    o.omega = damped / Real(odd);
    o.mass[0] = {p.m1, sign_of(odd) * Real(p.A), damped};
    o.mass[1] = {m2, -Real(p.r) * Real(p.A) * Real(odd), o.omega};
  }
  return o;
}

inline Oracle oracle_of(const ExactDataParameters& p) {
  Oracle o;
  o.omega = p.Omega;
  o.sigma = p.sigma;
  o.eta = p.eta;
  o.mass[0] = {Real(p.r) * Real(p.m2), Real(p.X) * Real(p.A_over_X), p.Omega};
  o.mass[1] = {p.m2, -sign_of(p.X) * Real(p.r) * Real(p.A_over_X), Real(p.X) * Real(p.Omega)};
  return o;
}

inline Oracle oracle_of(const RigidStopParameters& p) {
  Oracle o;
  o.dof = 1;
  o.sigma = p.xi1;
  o.omega = sqrt((1 - Real(p.xi1)) * (1 + Real(p.xi1)));
  o.eta = p.eta;
  o.mass[0] = {1, 1, o.omega};
  return o;
}

inline Oracle oracle_of(const FreeMassParameters& p) {
  auto o = oracle_of(RigidStopParameters{p.xi1, 1.0, p.t_end});
  o.collides = false;
  return o;
}

/// Random trials are multiplied by CLACKERS_TEST_EFFORT.
inline int trials(int standard) {
  const char* effort = std::getenv("CLACKERS_TEST_EFFORT");
  return effort == nullptr ? standard : standard * std::max(1, std::atoi(effort));
}

/// Random members of the parameter box, its corners among them.
class Box {
 public:
  explicit Box(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double decades(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  bool one_in(int n) { return std::uniform_int_distribution<int>(1, n)(random_) == 1; }

  double odd() {
    if (one_in(6)) return 1.0;
    if (one_in(6)) return 400001.0;
    const double largest = one_in(3) ? 2e5 : one_in(2) ? 500.0 : 5.0;
    return 2.0 * std::floor(uniform(0.0, largest)) + 1.0;
  }
  double damping_ratio() {
    if (one_in(4)) return 0.0;
    if (one_in(8)) return 1.0 - 0x1p-53;
    return one_in(2) ? uniform(0.0, 1.0) : decades(-14.0, 0.0);
  }
  double restitution() {
    if (one_in(3)) return 1.0;
    if (one_in(6)) return 0.0;
    if (one_in(6)) return 1.0 - decades(-12.0, -3.0);
    return one_in(6) ? decades(-320.0, -1.0) : uniform(0.0, 1.0);
  }
  /// Ends at most at 1e9 s, and after 3e8 half periods.
  PairParameters pair(double scale_decades = 8.0) {
    PairParameters p;
    p.m1 = decades(-scale_decades, scale_decades);
    p.k1 = decades(-scale_decades, scale_decades);
    p.xi1 = damping_ratio();
    p.A = decades(-scale_decades, scale_decades);
    const double odd_ratio = odd();
    const double r = odd_ratio == 1.0 ? decades(-3.0, 3.0)
                     : one_in(4)      ? 2.9999999999
                                      : decades(-4.0, 0.47);
    const bool exchanged = odd_ratio > 1.0 && one_in(3);
    p.X = exchanged ? 1.0 / odd_ratio : odd_ratio;
    p.r = exchanged ? 1.0 / r : r;
    p.eta = restitution();
    const double damped = std::sqrt(p.k1 / p.m1) * std::sqrt((1.0 - p.xi1) * (1.0 + p.xi1));
    p.t_end = std::min(1e9, 1e9 / (exchanged ? damped / odd_ratio : damped));
    return p;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace clackers::exact::testing_oracle
