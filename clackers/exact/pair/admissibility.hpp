#pragma once

#include <string_view>

#include "clackers/exact/pair/parameters.hpp"

namespace clackers::exact {

/// Which mass ratios keep the masses of a synchronized pair apart away from equilibrium: r < r*(X),
/// the sharp form of Eq. (18), with slow over fast mass r. Damping and restitution do not enter.
/// r* = -1 / min over theta of sin(X theta) / (X sin theta); equality grazes.

/// r*(X), the double nearest to it, for an odd whole X >= 1: infinity for 1, exactly 3 for 3, then
/// strictly rising towards 4.60333884875.
double r_star(double X);

/// X times the angle before an impact at which the gap is smallest, for odd X >= 5: the zero of
/// X sin(x/X) cos(x) - sin(x) cos(x/X) in (pi, 3 pi/2), to the last bit.
double graze_angle(double X);

/// The first contact of slow and fast mass away from equilibrium as an angle Omega t in
/// [0, pi/2), for odd X >= 3 and r >= r*(X); 0 when they touch or overlap at the start. Relative
/// error of pi/2 minus the angle below 1e-7 at a graze (where it is a double root), else 1e-12.
double first_contact_angle(double X, double r);

/// How the slow mass of a pair moves, for the message of require_admissible().
struct SlowMass {
  double omega = 1.0, sigma = 0.0;  ///< damped frequency, rate of decay [1/s]
  double start = 1.0;               ///< u(0) [m]
};

/// Throws InputError (not-admissible) unless r < r*, or r > 1/r* for X = 1/odd, decided to 1e-25
/// relative. The message says how far outside, when and where the masses would touch, and what to
/// change. `r` is m1/m2 as given.
void require_admissible(std::string_view who, const FrequencyRatio& ratio, double r,
                        const SlowMass& slow);

/// min (u1 - u2)/|u of the slow mass| over a flight: 1 - r/r*, or 1 - 1/(r r*) with X =
/// 1/odd; 1 + r for X = 1. 0 grazes.
double admissibility_margin(const FrequencyRatio& ratio, double r);

}  // namespace clackers::exact
