#pragma once

#include <vector>

#include "clackers/exact/flight_constants.hpp"
#include "clackers/exact/wide.hpp"
#include "clackers/model/impact_problem.hpp"

namespace clackers::exact {

/// A motion of this room told by few numbers of 384 bits, from which all constants follow.
struct WideMotion {
  struct Mass {
    Wide mass;              ///< [kg]
    Wide start;             ///< b = u(0) [m]
    double multiple = 1.0;  ///< p = damped frequency / Omega, odd

    /// k / m = p^2 Omega^2 + sigma^2 [1/s^2]
    Wide stiffness_over_mass(const WideMotion& motion) const;
  };

  std::vector<Mass> masses;
  Wide omega;  ///< Omega, the damped frequency whose half period parts the collisions [1/s]
  Wide sigma;  ///< common rate of decay [1/s]
  double eta = 1.0;
  double end = 0.0;
  bool collides = true;
};

/// The most collisions, or half periods, that a motion may have: the phase is then known to 2^-100.
inline constexpr double most_half_periods = 0x1p50;

/// Throws InputError unless 0 < t_end < infinity and Omega t_end / pi <= most_half_periods.
void require_end(std::string_view who, const WideMotion& motion);

/// The constants for evaluation, each the nearest double, double-double or triple-double.
FlightConstants flight_constants(const WideMotion& motion);

/// The system in model terms, each number the nearest double. One mass collides with a stop below
/// it at 0, two with each other (mass 1 above mass 2).
model::ImpactProblem<> impact_problem(const WideMotion& motion);

}  // namespace clackers::exact
