#pragma once

#include <string_view>
#include <variant>

namespace clackers::exact {

struct FreeMassParameters {
  double xi1 = 0.05;    ///< damping ratio, 0 or 1e-60 <= xi1 < 1
  double t_end = 20.0;  ///< [s]
};

struct RigidStopParameters {
  double xi1 = 0.05;    ///< damping ratio, 0 or 1e-60 <= xi1 < 1
  double eta = 1.0;     ///< restitution, 0 to 1
  double t_end = 20.0;  ///< [s]
};

/// The free parameters of a synchronized pair (docs/manual/explanation/derivations/motion.md; Eq. (25) is m1 =
/// k1 = A = 1, r = 3, eta = 1, X = 4N + 1).
struct PairParameters {
  double m1 = 1.0;      ///< mass 1, above [kg], 1e-60 to 1e60
  double k1 = 1.0;      ///< its stiffness [N/m], 1e-60 to 1e60
  double xi1 = 0.05;    ///< its damping ratio, 0 or 1e-60 <= xi1 < 1
  double A = 1.0;       ///< |u1(0)| [m], 1e-60 to 1e60
  double X = 9.0;       ///< damped frequency of mass 2 over that of mass 1: odd, or 1/odd
  double r = 3.0;       ///< m1/m2, below r*(X), or above 1/r*(1/X) for X = 1/odd; 1e-60 to 1e60
  double eta = 1.0;     ///< restitution, 0 to 1
  double t_end = 20.0;  ///< [s]
};

/// The free parameters of a pair with exact data; all but X and t_end short binary fractions.
struct ExactDataParameters {
  double m2 = 1.0;          ///< the fast mass [kg], 1e-30 to 1e30
  double Omega = 1.0;       ///< damped frequency of mass 1 [1/s], 1e-30 to 1e30
  double sigma = 0.0625;    ///< common rate of decay [1/s], 0 or 1e-30 to 1e30
  double A_over_X = 0.125;  ///< u1(0)/X [m], 1e-30 to 1e30
  double X = 9.0;           ///< odd whole number
  double r = 0.5;           ///< m1/m2, 1e-30 <= r < r*(X)
  double eta = 1.0;         ///< restitution, 0 to 1
  double t_end = 20.0;      ///< [s]
};

/// Those of any motion in closed form.
using Parameters =
    std::variant<FreeMassParameters, RigidStopParameters, PairParameters, ExactDataParameters>;

/// The ratio X of the damped frequencies of mass 2 and mass 1: an odd whole number, or 1 over one
/// when mass 1 is the fast one.
struct FrequencyRatio {
  double odd = 1.0;         ///< fast over slow: 1, 3, 5, ...
  bool is_inverse = false;  ///< true: X = 1/odd, for odd >= 3
};

/// The largest odd ratio that is taken. The reduced phase of the fast mass is then known to 2^-70.
inline constexpr double largest_ratio = 1e9;

/// Reads X: an odd whole number from 1 to largest_ratio, or the double nearest to 1 over one.
/// Throws InputError, naming the nearest odd numbers.
FrequencyRatio frequency_ratio(std::string_view who, double X);

/// s = sin(X pi/2) = (-1)^((X-1)/2) of an odd whole number.
double quarter_sine(double odd);

/// Masses, stiffnesses, amplitudes and mass ratios may span 120 decades. Then no product of them
/// that a motion needs leaves the normal doubles.
inline constexpr double smallest_scale = 1e-60, largest_scale = 1e60;

/// Throws InputError unless smallest <= value <= largest (the limits above unless given).
void require_scale(std::string_view who, std::string_view name, double value,
                   double smallest = smallest_scale, double largest = largest_scale);
/// Throws InputError unless 0 <= eta <= 1.
void require_restitution(std::string_view who, double eta);
/// Throws InputError unless each parameter by itself is in its range; t_end is left to derive().
void require_ranges(std::string_view who, const Parameters& parameters);

}  // namespace clackers::exact
