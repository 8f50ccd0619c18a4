#pragma once

#include <complex>
#include <optional>
#include <string_view>

#include "clackers/exact/orbit/flights.hpp"

namespace clackers::exact {

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

/// Two damped masses under forces F_i cos(nu t + phi_i), nu = 2 pi n/T, that collide every T seconds
/// with the same velocities: V_i just after, -V_i/eta just before, zero momentum. Impacts are at
/// t_k = (k - 1/2) T, so that t = 0 is in the middle of a flight. In a flight, s seconds after an
/// impact, with B = V (1 + eta)/(2 eta w (cosh sigma T - cos w T)),
///
///     u = e^(-sigma s) (P cos w s + Q sin w s) + p(s),  P = B sin w T,  Q = B (e^(sigma T) - cos w T),
///     p = (D - P) cos nu s + (V - w Q + sigma P)/nu sin nu s,
///
/// which determines the force. Derivation: docs/manual/explanation/derivations/orbits.md.
class ForcedPair : public Flights {
 public:
  /// Throws InputError for parameters outside their ranges; where an undamped frequency makes whole
  /// oscillations between impacts give or take 1e-4 rad (not-admissible); and
  /// where the masses would meet earlier (not-admissible): when, by how much they would overlap, and
  /// what to change.
  explicit ForcedPair(const ForcedPairParameters& parameters, std::string_view who = "forced-pair");
  /// u'' + omega^2 u = -A_g cos nu s of both masses relative to the base; m2 follows. Throws as above,
  /// and unless V1 > 0 > V2 (not-admissible).
  explicit ForcedPair(const BaseExcitedParameters& parameters,
                      std::string_view who = "base-excited-pair");

  /// The largest values of an orbit, on 2048 instants of it: less than 1 % too small as long as the
  /// fastest oscillation has 40 of them.
  model::Kinematics envelope(double t) const override;

  double T() const { return T_.nearest(); }
  double nu() const { return nu_.nearest(); }
  /// Just after an impact [m/s], of mass `i` = 0 or 1.
  double velocity(int i) const { return masses_[std::size_t(i)].V.nearest(); }
  /// Smallest gap over (V1 - V2) s (T - s)/T, the parabola of the same start: 1 and 1/eta at the ends.
  double margin() const { return margin_; }
  /// Eigenvalues of the linear map of perturbations from just after an impact to just after the next:
  /// the orbit is stable where all are less than 1 in modulus. Largest first.
  std::array<std::complex<double>, 4> floquet_multipliers() const;

 protected:
  Bounded instant(long long k) const override;
  States state(long long k, const Bounded& s) const override;
  long long near_flight(double t) const override;
  Limits limits(long long k) const override;

 private:
  template <class Real>
  struct MassOf {
    Real m, w, sigma, D, V;
    Real P, Q, p0, p1;  // p = p0 cos nu s + p1 sin nu s
    Real square() const { return w * w + sigma * sigma; }
  };
  using Mass = MassOf<Bounded>;
  // Constants are computed with 256 bits.
  class Constants;
  Constants begin(double T, double n, double eta);
  struct Force {
    double amplitude, phase;
  };
  struct Closing {
    double at = 0.0, overlap = 0.0;
  };

  ForcedPair() = default;
  // What an orbit is, before its gap is looked at.
  void build(std::string_view who, const ForcedPairParameters& p);
  void build(std::string_view who, const BaseExcitedParameters& p);
  void require_open(std::string_view who, const auto& p) const;
  MassState mass_state(const Mass& mass, const Bounded& s) const;
  // Nothing where the gap stays open from one impact to the next.
  std::optional<Closing> closing() const;
  double smallest_share() const;
  void find_size();
  Force force(const Mass& mass) const;
  void make_problem(double t_end);

  Bounded T_, nu_;
  double n_ = 1.0, eta_ = 1.0, margin_ = 0.0;
  std::array<Mass, 2> masses_;
  model::Kinematics size_;
};

}  // namespace clackers::exact
