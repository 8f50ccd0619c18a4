#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "clackers/exact/testing/real.hpp"

// For tests: two damped oscillators that collide, simulated from one impact to the next with 90
// digits. It knows masses, springs, dashpots and a start, and nothing of synchrony, admissibility
// or any closed form.
namespace clackers::exact::testing_oracle {

/// The force amplitude cos(frequency t + phase) on one mass.
struct RawForce {
  Real amplitude = 0, frequency = 0, phase = 0;
};

/// The numbers of the model. The masses may not pass: u1 - u2 >= -gap.
struct RawPair {
  Real m1, m2, k1, k2, c1, c2;  ///< SI; c^2 < 4 m k for each mass
  Real eta;                     ///< restitution, 0 to 1
  Real gap;                     ///< may be negative: masses that press when at rest
  Real u10, u20, v10, v20;      ///< at t = 0, where u1 - u2 >= -gap
  RawForce force1{}, force2{};
};

/// Displacement, velocity and acceleration of both masses at t.
struct RawState {
  Real t;
  std::array<Real, 2> u, v, a;
};

struct RawPairImpact {
  RawState before, after;  ///< at the same t
  Real impulse;            ///< on mass 1, upward [N s]
  Real energy_before, energy_after;
};

/// One mass on its spring and dashpot from a given state: u = e^(-sigma s) (p cos w s + q sin w s)
/// and the steady response to its force, by undetermined coefficients.
class FreeMass90 {
 public:
  FreeMass90(const Real& m, const Real& c, const Real& k, const RawForce& force = {});
  void start(const Real& t, const Real& u, const Real& v);
  /// State `s` seconds after start(), into the arrays' entry i.
  void put(const Real& s, RawState& to, std::size_t i) const;
  bool is_forced() const { return force_.amplitude != 0; }
  /// Of the steady response: |u''| is at most this.
  Real steady_curvature() const;
  const Real& mass() const { return m_; }
  const Real& sigma() const { return sigma_; }
  /// sqrt(p^2 + q^2): |u| <= amplitude e^(-sigma s).
  const Real& amplitude() const { return amplitude_; }
  /// The factor by which each derivative of e^(shift s) u may grow: |-(sigma - shift) + i w|.
  Real rate(const Real& shift) const;
  Real energy(const RawState& x, std::size_t i) const;

 private:
  // The steady response or its rate.
  Real steady(const Real& t, int derivative) const;

  Real m_, c_, k_, sigma_, w_, p_ = 0, q_ = 0, amplitude_ = 0;
  RawForce force_;
  Real t_ = 0, steady_cos_ = 0, steady_sin_ = 0;
};

/// Goes from impact to impact. The first contact of a flight cannot be missed: with a number `rate`
/// that both masses decay at least with, G(s) = e^(rate s) (u1 - u2 + gap) has the zeros of the
/// gap, and |G''| <= M from s on (M below). From a known s it stays positive as long as
/// G + G' x - M x^2 / 2 does, so s moves to the zero x of that parabola, again and again. Near a
/// crossing these steps are Newton's, from the safe side, and converge as fast. No sampling.
class ImpactSimulator {
 public:
  explicit ImpactSimulator(const RawPair& p);

  /// The state at t, within the present flight: t >= flight_start(), and no contact before t.
  RawState at(const Real& t) const;
  const Real& flight_start() const { return start_.t; }
  Real energy(const RawState& x) const { return masses_[0].energy(x, 0) + masses_[1].energy(x, 1); }

  /// Goes through the next contact if it is not later than `until`; otherwise stays where it is and
  /// returns nothing. Throws std::domain_error for a graze, where the gap comes within 1e-70 of
  /// the amplitudes and nothing proves a crossing, and for what follows an impact with eta = 0.
  std::optional<RawPairImpact> next(const Real& until);

 private:
  void fly_from(const RawState& x);
  Real gap(const RawState& x) const { return x.u[0] - x.u[1] + gap_; }
  // What rounding may do to a gap: amplitudes times 2^-300, and 20 decades more.
  Real tiny() const;

  std::optional<Real> first_contact(const Real& until) const;

  std::array<FreeMass90, 2> masses_;
  Real eta_, gap_, shift_, bound_;
  RawState start_;
  int hits_ = 0;
};

/// The states at `times` (rising; at an impact the state after it).
std::vector<RawState> simulate(const RawPair& pair, std::span<const Real> times);

}  // namespace clackers::exact::testing_oracle
