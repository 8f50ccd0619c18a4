#pragma once

#include <array>
#include <variant>

namespace clackers::exact {

/// The free parameters of a cradle. Both masses are 1 kg and u1(0) = 1 m.
struct CradleParameters {
  double omega1 = 1.0;  ///< undamped frequency of mass 1, above [rad/s], 1e-30 to 1e30
  double omega2 = 1.7;  ///< of mass 2 [rad/s]
  double xi1 = 0.05;    ///< damping ratio of mass 1, 0 <= xi1 < 1
  double xi2 = 0.05;    ///< of mass 2
  double t_end = 20.0;  ///< [s]
};

/// The free parameters of a periodic orbit with impacts under harmonic forces.
struct ForcedPairParameters {
  double m1 = 1.0, m2 = 1.0;            ///< masses, 1 above [kg], 1e-30 to 1e30
  double omega1 = 1.0, omega2 = 3.0;    ///< damped frequencies [rad/s], 1e-30 to 1e30
  double sigma1 = 0.05, sigma2 = 0.05;  ///< rates of decay [1/s], >= 0
  double eta = 0.8;                     ///< restitution, 1e-3 to 1
  double T = 5.0;                       ///< time between impacts [s]
  double n = 2.0;                       ///< periods of the force between impacts, 1 to 1e6
  double D1 = -0.25, D2 = 0.25;         ///< displacements at the contact [m]
  double V1 = 0.5;                      ///< velocity of mass 1 just after an impact [m/s], > 0
  double t_end = 40.0;                  ///< [s]
};

/// The free parameters of the orbit under base excitation: undamped, elastic, touching at rest.
struct BaseExcitedParameters {
  double m1 = 1.0;                    ///< mass 1, above [kg]
  double omega1 = 1.0, omega2 = 3.5;  ///< frequencies [rad/s]
  double T = 2.5;                     ///< time between impacts [s]
  double n = 1.0;                     ///< periods of the base between impacts
  double A_g = -1.0;                  ///< amplitude of the base's acceleration [m/s^2], not 0
  double t_end = 20.0;                ///< [s]
};

/// A point of unit mass within a circle of radius R around the origin.
struct CircleBilliardParameters {
  double R = 1.0;                                 ///< [m]
  double x0 = 0.0, y0 = 0.0, vx = 1.0, vy = 0.0;  ///< at t = 0 [m, m/s]
  double end = 20.0;                              ///< [s]
};

/// A ball of unit mass above a floor.
struct BallParameters {
  double h0 = 1.0, v0 = 0.0;   ///< height above the floor and velocity upwards at t = 0 [m, m/s]
  double g = 9.81, eta = 0.8;  ///< gravity [m/s^2], restitution
  double end = 5.0;            ///< [s]
};

/// A disk or ball of unit mass that is thrown on a rough floor, turning.
struct ObliqueDiskParameters {
  BallParameters height;        ///< its height is that of a ball
  double vx0 = 1.0, w0 = 0.0;   ///< velocity along the floor, and R times that of rotation [m/s]
  double mu = 0.1, beta = 0.5;  ///< coefficient of friction; moment of inertia over m R^2
};

/// A mass on a spring [kg, N/m] that dry friction F [N] brings to rest, from rest at x0 [m].
struct SliderParameters {
  double m = 1.0, k = 1.0, F = 0.1, x0 = 1.0, end = 20.0;
};

/// The same on a belt of velocity V [m/s], with a limit of static friction and kinetic friction [N].
struct BeltParameters {
  double m = 1.0, k = 1.0, limit = 1.0, kinetic = 0.5, V = 0.2, end = 40.0;
};

/// The same under P cos(W t + phi) [N, rad/s].
struct ForcedSliderParameters {
  double m = 1.0, k = 1.0, F = 0.4, P = 1.0, W = 0.8, end = 40.0;
};

/// A pendulum of length l [m] under gravity g [m/s^2], from rest at the angle theta0 [rad] above a stop.
struct PendulumParameters {
  double l = 1.0, g = 9.81, theta0 = 1.0, eta = 0.8, end = 10.0;
};

/// A mass on a spring of force k u + b u^3 [kg, N/m, N/m^3], from rest at u0 [m] above a stop.
struct DuffingParameters {
  double m = 1.0, k = 1.0, b = 1.0, u0 = 1.0, eta = 0.8, end = 20.0;
};

/// Two pendula that meet at their lowest points with opposite momenta: masses [kg], length of the first [m] and the
/// angle where it starts at rest [rad].
struct TwoPendulaParameters {
  double m1 = 1.0, m2 = 1.0, l1 = 1.0, g = 9.81, theta1 = 1.0, end = 10.0;
};

/// Two pendula of equal mass that swing in turn.
struct PendulumCradleParameters {
  double l1 = 1.0, l2 = 0.8, g = 9.81, theta1 = 1.0, end = 10.0;
};

using FlightsParameters =
    std::variant<std::monostate, CradleParameters, ForcedPairParameters, BaseExcitedParameters,
                 CircleBilliardParameters, BallParameters, ObliqueDiskParameters, SliderParameters,
                 BeltParameters, ForcedSliderParameters, PendulumParameters, DuffingParameters,
                 TwoPendulaParameters, PendulumCradleParameters>;

/// Numbers of a type Real that bounds their errors.
template <class Real>
struct MassStateOf {
  Real u, v, a;
};
template <class Real>
using StatesOf = std::array<MassStateOf<Real>, 3>;  // of the masses that there are
/// Both limits at an impact.
template <class Real>
struct LimitsOf {
  StatesOf<Real> before, after;
  Real impulse;
};

/// What Cradle says of the motion.
template <class Real>
struct CradleFormulas {
  struct Mass {
    Real omega, sigma, w, half_period, decay;  // decay = sigma half_period
    Mass() = default;
    Mass(double omega_, double xi)
        : omega(omega_),
          sigma(Real(xi) * omega),
          w(omega * sqrt((Real(1.0) - xi) * (Real(1.0) + xi))),
          half_period(Real::pi() / w),
          decay(sigma * half_period) {}
  };
  std::array<Mass, 2> masses;

  CradleFormulas() = default;
  explicit CradleFormulas(const CradleParameters& p)
      : masses{Mass(p.omega1, p.xi1), Mass(p.omega2, p.xi2)} {}

  // Flights of mass 1 and mass 2 before flight k: (k + 1) / 2 and k / 2.
  Real instant(long long k) const {
    return (Real(double((k + 1) / 2)) - 0.5) * masses[0].half_period +
           Real(double(k / 2)) * masses[1].half_period;
  }
  /// At the beginning of flight k; u1(0) = 1 in the middle of flight 0.
  Real speed(long long k) const {
    return masses[0].w * exp(-((Real(double((k + 1) / 2)) - 0.5) * masses[0].decay +
                               Real(double(k / 2)) * masses[1].decay));
  }
  StatesOf<Real> state(long long k, const Real& s) const {
    const auto& mass = masses[std::size_t(k % 2)];
    const Real start = k % 2 == 0 ? speed(k) : -speed(k);
    const Real decayed = start * exp(-(mass.sigma * s)), phase = mass.w * s;
    StatesOf<Real> states;
    auto& now = states[std::size_t(k % 2)];
    now.u = decayed * sin(phase) / mass.w;
    now.v = decayed * cos(phase) - mass.sigma * now.u;
    now.a = -(Real(2.0) * mass.sigma * now.v + mass.omega * mass.omega * now.u);
    return states;
  }
  LimitsOf<Real> limits(long long k) const {
    const auto arriving = std::size_t((k - 1) % 2), leaving = 1 - arriving;
    const Real v = arriving == 0 ? -speed(k) : speed(k);
    LimitsOf<Real> limit;
    const auto damped = [&](std::size_t mass) {
      return MassStateOf<Real>{0.0, v, -(Real(2.0) * masses[mass].sigma * v)};
    };
    limit.before[arriving] = damped(arriving);
    limit.after[leaving] = damped(leaving);
    limit.impulse = speed(k);
    return limit;
  }
  /// Of an impact, where u = 0.
  Real energy(const StatesOf<Real>& x) const { return (x[0].v * x[0].v + x[1].v * x[1].v) * 0.5; }
  /// Of mass i in the middle of flight 0.
  bool turns(std::size_t i, long long, double t) const {
    return t == 0.0 && masses[i].sigma.is_zero();
  }
};

/// What ForcedPair says of the orbit.
template <class Real>
struct OrbitFormulas {
  struct Mass {
    Real m, w, sigma, D, V;
    Real P, Q, p0, p1;  // p = p0 cos nu s + p1 sin nu s
    Real square() const { return w * w + sigma * sigma; }
  };
  Real T, nu;
  double n = 1.0, eta = 1.0;
  std::array<Mass, 2> masses;

  OrbitFormulas() = default;
  explicit OrbitFormulas(const ForcedPairParameters& p) : OrbitFormulas(p.T, p.n, p.eta) {
    const Real V2 = -(Real(p.m1) * p.V1 / p.m2);
    masses = {complete({p.m1, p.omega1, p.sigma1, p.D1, p.V1, {}, {}, {}, {}}),
              complete({p.m2, p.omega2, p.sigma2, p.D2, V2, {}, {}, {}, {}})};
  }
  explicit OrbitFormulas(const BaseExcitedParameters& p) : OrbitFormulas(p.T, p.n, 1.0) {
    const auto velocity = [&](double omega) {
      const Real half = Real(omega) * T * 0.5;
      return Real(p.A_g) * omega * sin(half) /
             (cos(half) * (Real(omega) + nu) * (Real(omega) - nu));
    };
    const Real V1 = velocity(p.omega1), V2 = velocity(p.omega2), m2 = -(Real(p.m1) * V1 / V2);
    masses = {complete({p.m1, p.omega1, 0.0, 0.0, V1, {}, {}, {}, {}}),
              complete({m2, p.omega2, 0.0, 0.0, V2, {}, {}, {}, {}})};
  }

  Real instant(long long k) const { return (Real(double(k)) - 0.5) * T; }
  StatesOf<Real> state(long long, const Real& s) const {
    return {mass_state(masses[0], s), mass_state(masses[1], s)};
  }
  MassStateOf<Real> mass_state(const Mass& mass, const Real& s) const {
    const Real decay = exp(-(mass.sigma * s));
    const Real phase = mass.w * s, turn = Real(2.0) * Real::pi() * n * (s / T);
    const Real c = cos(phase), d = sin(phase), C = cos(turn), N = sin(turn);
    const Real h = decay * (mass.P * c + mass.Q * d);
    const Real h1 = decay * mass.w * (mass.Q * c - mass.P * d) - mass.sigma * h;
    const Real h2 = -(Real(2.0) * mass.sigma * h1 + mass.square() * h);
    const Real p = mass.p0 * C + mass.p1 * N, p1 = nu * (mass.p1 * C - mass.p0 * N);
    return {h + p, h1 + p1, h2 - nu * nu * p};
  }
  LimitsOf<Real> limits(long long) const {
    LimitsOf<Real> limit;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& mass = masses[i];
      // The force, the displacement and so the spring are the same on either side.
      const auto after = mass_state(mass, 0.0);
      const Real V = -(mass.V / eta);
      limit.before[i] = {mass.D, V, after.a - Real(2.0) * mass.sigma * (V - mass.V)};
      limit.after[i] = {mass.D, mass.V, after.a};
    }
    limit.impulse = masses[0].m * masses[0].V * (Real(1.0) + Real(1.0) / eta);
    return limit;
  }
  Real energy(const StatesOf<Real>& x) const {
    Real sum;
    for (std::size_t i = 0; i < 2; ++i)
      sum = sum + masses[i].m * (x[i].v * x[i].v + masses[i].square() * x[i].u * x[i].u) * 0.5;
    return sum;
  }
  /// Of a mass that moves forwards as backwards, in the middle of flight k.
  bool turns(std::size_t i, long long k, double t) const {
    return eta == 1.0 && masses[i].sigma.is_zero() && (Real(double(k)) * T - t).is_zero();
  }

 private:
  OrbitFormulas(double T_, double n_, double eta_)
      : T(T_), nu(Real(2.0) * Real::pi() * n_ / T), n(n_), eta(eta_) {}
  // P, Q and the particular solution, from V and D.
  Mass complete(Mass mass) const {
    const Real half = mass.w * T * 0.5, damped = mass.sigma * T;
    const Real sine = sin(half), growth = sinh(damped * 0.5);
    const Real B =
        mass.V * (Real(1.0) + eta) / (Real(4.0) * eta * mass.w * (growth * growth + sine * sine));
    mass.P = B * 2.0 * sine * cos(half);
    mass.Q = B * (expm1(damped) + Real(2.0) * sine * sine);
    mass.p0 = mass.D - mass.P;
    mass.p1 = (mass.V - mass.w * mass.Q + mass.sigma * mass.P) / nu;
    return mass;
  }
};

}  // namespace clackers::exact
