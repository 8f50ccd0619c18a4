#pragma once

#include <string_view>

#include "clackers/exact/orbit/flights.hpp"

namespace clackers::exact {

/// Two equal masses that touch at rest and collide elastically, one of them at rest at each impact:
/// they exchange their velocities, as the balls of Newton's cradle do. Mass 1 is away above while
/// mass 2 rests, then mass 2 below while mass 1 rests; a flight of mass i is half a damped period
/// T_i = pi/omega_Di, for any frequencies and dampings:
///
///     u_i = -+ V_k e^(-sigma_i s) sin(omega_Di s)/omega_Di,  V_(k+1) = V_k e^(-sigma_i T_i)
///
/// Derivation: docs/manual/explanation/derivations/orbits.md.
class Cradle : public FlightsBy<Flights, CradleFormulas> {
 public:
  /// Throws InputError for parameters outside their ranges, and for a run in which a phase exceeds
  /// 1e12 rad, beyond which the error bound would no longer be small.
  explicit Cradle(const CradleParameters& parameters, std::string_view who = "cradle");

  model::Kinematics envelope(double t) const override;

  /// Length of a flight of mass `i` = 0 or 1 [s].
  double flight_time(int i) const { return formulas_.masses[std::size_t(i)].half_period.nearest(); }
  /// By how much a perturbation relative to the motion grows from one impact to the next in the long
  /// run, at least 1: that of the resting mass may grow, or decay more slowly than the motion.
  double perturbation_growth() const;

 protected:
  long long near_flight(double t) const override;
};

}  // namespace clackers::exact
