#pragma once

#include <complex>
#include <optional>
#include <string_view>

#include "clackers/exact/orbit/flights.hpp"

namespace clackers::exact {

/// Two damped masses under forces F_i cos(nu t + phi_i), nu = 2 pi n/T, that collide every T seconds
/// with the same velocities: V_i just after, -V_i/eta just before, zero momentum. Impacts are at
/// t_k = (k - 1/2) T, so that t = 0 is in the middle of a flight. In a flight, s seconds after an
/// impact, with B = V (1 + eta)/(2 eta w (cosh sigma T - cos w T)),
///
///     u = e^(-sigma s) (P cos w s + Q sin w s) + p(s),  P = B sin w T,  Q = B (e^(sigma T) - cos w T),
///     p = (D - P) cos nu s + (V - w Q + sigma P)/nu sin nu s,
///
/// which determines the force. Derivation: docs/manual/explanation/derivations/orbits.md.
class ForcedPair : public FlightsBy<Flights, OrbitFormulas> {
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

  double T() const { return formulas_.T.nearest(); }
  double nu() const { return formulas_.nu.nearest(); }
  /// Just after an impact [m/s], of mass `i` = 0 or 1.
  double velocity(int i) const { return formulas_.masses[std::size_t(i)].V.nearest(); }
  /// Smallest gap over (V1 - V2) s (T - s)/T, the parabola of the same start: 1 and 1/eta at the ends.
  double margin() const { return margin_; }
  /// Eigenvalues of the linear map of perturbations from just after an impact to just after the next:
  /// the orbit is stable where all are less than 1 in modulus. Largest first.
  std::array<std::complex<double>, 4> floquet_multipliers() const;

 protected:
  long long near_flight(double t) const override;

 private:
  using Mass = OrbitFormulas<Bounded>::Mass;
  struct Force {
    double amplitude, phase;
  };
  struct Closing {
    double at = 0.0, overlap = 0.0;
  };

  explicit ForcedPair(const FlightsParameters& parameters)
      : FlightsBy(OrbitFormulas<Bounded>(), parameters) {}
  // What an orbit is, before its gap is looked at.
  void build(std::string_view who, const ForcedPairParameters& p);
  void build(std::string_view who, const BaseExcitedParameters& p);
  void require_open(std::string_view who, const auto& p) const;
  // Nothing where the gap stays open from one impact to the next.
  std::optional<Closing> closing() const;
  double smallest_share() const;
  void find_size();
  Force force(const Mass& mass) const;
  void make_problem(double t_end);

  double margin_ = 0.0;
  model::Kinematics size_;
};

}  // namespace clackers::exact
