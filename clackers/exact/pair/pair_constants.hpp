#pragma once

#include "clackers/exact/pair/frequency_ratio.hpp"

namespace clackers::exact {

/// What follows from the free parameters of a pair, each value the nearest double. SI units.
struct PairConstants {
  FrequencyRatio ratio;
  double m1 = 0.0, m2 = 0.0;              ///< [kg]
  double c1 = 0.0, c2 = 0.0;              ///< [N s/m]
  double k1 = 0.0, k2 = 0.0;              ///< [N/m]
  double omega1 = 0.0, omega2 = 0.0;      ///< undamped frequencies [1/s]
  double omega_D1 = 0.0, omega_D2 = 0.0;  ///< damped frequencies [1/s]
  double xi1 = 0.0, xi2 = 0.0;            ///< damping ratios, Eq. (15)
  double sigma = 0.0;                     ///< common rate of decay, Eq. (12) [1/s]
  double u1 = 0.0, u2 = 0.0;              ///< initial displacements, Eq. (13) [m]
  double v1 = 0.0, v2 = 0.0;              ///< initial velocities, Eq. (17) [m/s]
  double period = 0.0;                    ///< T, time between collisions [s]
  double first_collision = 0.0;           ///< t_1 = T/2 [s]
  double r_star = 0.0;  ///< limit of slow over fast mass; infinity for equal frequencies
  double margin = 0.0;  ///< see admissibility_margin
};

struct WideMotion;

/// `motion` has two masses, numbered as the user does.
PairConstants pair_constants(const WideMotion& motion, const FrequencyRatio& ratio);

}  // namespace clackers::exact
