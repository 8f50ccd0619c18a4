#pragma once

#include <string_view>
#include <vector>

#include "clackers/exact/pair/wide.hpp"

namespace clackers::exact {

/// A motion of this module told by few numbers of 384 bits, from which flight_constants() and
/// impact_problem() follow.
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

}  // namespace clackers::exact
