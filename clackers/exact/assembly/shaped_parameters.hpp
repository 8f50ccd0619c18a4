#pragma once

#include <cstddef>
#include <string_view>
#include <variant>

// The free parameters of the motions of any number of masses.
namespace clackers::exact {

/// Two shear buildings (building_shape.hpp) whose roofs touch at rest. Displacements are positive
/// away from the right building; the masses are those of the left building, roof first, then
/// those of the right one. At t = 0 the roofs part with opposite momenta.
struct BuildingsParameters {
  double left = 3.0;    ///< storeys, a whole number from 1 to most_storeys
  double right = 2.0;   ///< the same
  double X = 1.0;       ///< frequencies of the right building over those of the left one: odd
  double r = 1.0;       ///< left over right roof mass, below buildings_limit(); 1e-60 to 1e60
  double m1 = 1.0;      ///< left roof mass [kg], 1e-60 to 1e60
  double Omega = 1.0;   ///< lowest damped frequency of the left building [rad/s], 1e-60 to 1e60
  double sigma = 0.05;  ///< common rate of decay [1/s], 0 or 1e-60 to 1e60
  double V = 1.0;       ///< speed of the left roof at t = 0 [m/s], 1e-60 to 1e60
  double eta = 1.0;     ///< restitution, 0 to 1
  double t_end = 20.0;  ///< [s]
};

/// Masses one above the other, each on its own spring and dashpot, that may not pass their
/// neighbours: all contacts close together. At most one is faster, by the odd X. The masses above the
/// middle (or above the fast one) move up just after an impact, with 1, 2, 3, ... m/s from the middle
/// outwards, those below down; the fast one moves with `speed`, down if it is the last. Masses
/// that move up have mass m1, the others the mass with which the total momentum is zero.
struct RowParameters {
  double masses = 5.0;  ///< a whole number, 2 or more
  double fast = 3.0;    ///< number of the fast mass; 0 for none
  double X = 3.0;       ///< its frequency over that of the others: odd; without effect if fast = 0
  double speed = 0.5;   ///< of the fast mass just after an impact, over that of its slow neighbours
  double m1 = 1.0;      ///< [kg], 1e-60 to 1e60
  double Omega = 1.0;   ///< damped frequency of the slow masses [rad/s], 1e-60 to 1e60
  double sigma = 0.05;  ///< common rate of decay [1/s], 0 or 1e-60 to 1e60
  double eta = 1.0;     ///< restitution of all contacts, 0 to 1
  double t_end = 20.0;  ///< [s]
};

/// Three masses one above the other, each on its own spring and dashpot, elastic: the middle one meets
/// the lower and the upper one in turn, every half of an outer half-period, and passes equilibrium
/// rh - 1 times between two impacts. The outer ones have mass 1 kg and an amplitude of 1 m. At t = 0,
/// half way between two impacts, the middle mass is at equilibrium.
struct AlternatingParameters {
  double rh = 2.0;  ///< half-periods of the middle mass between impacts: even, up to 5e8
  double r = 1.0;   ///< outer over middle mass, below r*(2 rh); 1e-60 to 1e60
  double Omega =
      1.0;  ///< damped frequency of the outer masses [rad/s], 1e-60 to 5e59; middle: 2 rh times it
  double sigma = 0.05;  ///< common rate of decay [1/s], 0 or 1e-60 to 1e60
  double t_end = 20.0;  ///< [s]
};

/// Which entries of S are not zero.
enum class Coupling {
  chain,  ///< each coordinate with the one before it: tridiagonal matrices
  block,  ///< two pairs with each other
  dense,  ///< all
};

/// Synchronized pairs with k1 = m1 (omega1 = 1 rad/s), X = 4N + 1 and one damping ratio, seen through a
/// matrix: x = S u, where x_(2j), x_(2j+1) are the slow and the fast mass of pair j, counted from 0, and
/// u the displacements of the assembly. S is lower triangular with ones on its diagonal. Masses,
/// mass ratios, amplitudes and S are short binary fractions made from the seed alone.
struct AssemblyParameters {
  double pairs = 4.0;  ///< a whole number from 1 to 1e9
  Coupling coupling = Coupling::chain;
  double seed = 1.0;    ///< a whole number from 0 to 2^53
  double X = 9.0;       ///< 4N + 1
  double xi1 = 0.05;    ///< 0 or 1e-60 <= xi1 < 1
  double eta = 1.0;     ///< restitution of all contacts, 0 to 1
  double t_end = 20.0;  ///< [s]
};

/// Those of a ShapedMotion.
using ShapedParameters =
    std::variant<BuildingsParameters, RowParameters, AlternatingParameters, AssemblyParameters>;

/// Returns `value`, or throws InputError unless it is a whole number within [lowest, highest]; the
/// reasons complete the messages for a number that is none (not-whole) and one outside.
double require_whole(std::string_view who, std::string_view name, double value, double lowest,
                     double highest, std::string_view reason = {});

/// The memory that an ImpactProblem of n masses and as many contacts takes: three matrices and a row
/// for each contact.
inline constexpr double largest_problem = 0x1p30;  ///< [byte]
double problem_bytes(double masses, double contacts);

/// Throws InputError (out-of-range), with the size, unless such a problem takes at most
/// largest_problem. `name` = `value` is the parameter that decides.
void require_problem_fits(std::string_view who, std::string_view name, double value, double masses,
                          double contacts);

/// Returns X, an odd whole number up to largest_ratio; throws InputError, also for 1 over an odd
/// number, with the hint `instead`.
double require_odd(std::string_view who, double X, std::string_view instead);

}  // namespace clackers::exact
