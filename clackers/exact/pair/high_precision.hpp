#pragma once

#include <optional>
#include <string_view>

#include "clackers/exact/pair/parameters.hpp"
#include "clackers/exact/pair/sampling.hpp"
#include "clackers/model/impact_problem.hpp"

namespace clackers::exact {

/// What follows from the free parameters of a pair, each value the nearest double. SI units.
struct PairConstants {
  FrequencyRatio ratio;
  double r = 1.0;                         ///< m1/m2 as given
  double m1 = 0.0, m2 = 0.0;              ///< [kg]
  double c1 = 0.0, c2 = 0.0;              ///< [N s/m]
  double k1 = 0.0, k2 = 0.0;              ///< [N/m]
  double omega1 = 0.0, omega2 = 0.0;      ///< undamped frequencies [1/s]
  double omega_D1 = 0.0, omega_D2 = 0.0;  ///< damped frequencies [1/s]
  double xi1 = 0.0, xi2 = 0.0;            ///< damping ratios, Eq. (15)
  double sigma = 0.0;                     ///< common rate of decay, Eq. (12) [1/s]
  double u1 = 0.0, u2 = 0.0;              ///< initial displacements, Eq. (13) [m]
  double v1 = 0.0, v2 = 0.0;              ///< initial velocities, Eq. (17) [m/s]
  double period = 0.0;                    ///< T, time between impacts [s]
  double first_impact = 0.0;              ///< t_1 = T/2 [s]
  double r_star = 0.0;  ///< limit of slow over fast mass; infinity for equal frequencies
  double margin = 0.0;  ///< see admissibility_margin
};

/// What is derived from the parameters of a motion, with 384 bits and then rounded once.
struct Derived {
  FlightConstants flight;  ///< each constant the nearest double, double-double or triple-double
  /// The system in model terms, each number the nearest double. One mass collides with a stop below
  /// it at 0, two with each other (mass 1 above mass 2).
  model::ImpactProblem<> problem;
  std::optional<PairConstants> pair;  ///< of two masses
};

/// Throws InputError for parameters outside their ranges, for mass ratios beyond r*(X), and for exact
/// data with which some model input is no binary64 number; `who` opens the message.
Derived derive(std::string_view who, const Parameters& parameters);

/// What derive() puts into FlightConstants for any masses with the slowest damped frequency Omega
/// [1/s], from 1e-60 to 1e60, and the common rate of decay sigma [1/s], 0 or in the same range: all
/// but the constants of masses, impulse and energy. Throws as derive().
FlightConstants derive_flight(std::string_view who, double omega, double sigma, double eta,
                              double end);

/// r/r*(X) - 1, or its negative beyond 1/r*, for r = m1/m2: below 0 where the masses stay apart; 0
/// where they graze, which is decided to 1e-25.
double excess_over_r_star(const FrequencyRatio& ratio, double r);

/// The largest whole n with |4 n^2 - odd^2| threshold <= peak, for n up to 1e15.
double highest_harmonic(double odd, double peak, double threshold);

}  // namespace clackers::exact
