#pragma once

#include <memory>
#include <string_view>

#include "clackers/exact/assembly/shaped_motion.hpp"
#include "clackers/model/impact_problem.hpp"

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

/// The limit r* of r: the least value over the angles theta in (0, pi) where I_R(X theta) < 0 of
/// -X I_L(theta) / I_R(X theta), with I_n(x) the integral of cos^(2n-1) from 0 to x. Infinite for
/// X = 1.
struct BuildingsLimit {
  double r_star = 0.0;  ///< attained at `angle`, to the last digits
  double proven = 0.0;  ///< no smaller value exists: r_star (1 - 1e-8), by bounds on intervals
  double angle = 0.0;   ///< Omega t after an impact, in (0, pi/2]; the mirrored one is pi less it
};
BuildingsLimit buildings_limit(int left, int right, double X);

/// Throws InputError for parameters outside their ranges and (not-admissible) for r not below the
/// proven limit, where the roofs would touch away from equilibrium.
std::unique_ptr<const ShapedMotion> make_buildings(const BuildingsParameters& parameters,
                                                   std::string_view who = "buildings");

/// What a method is given; the same refusals.
model::ImpactProblem<> buildings_problem(const BuildingsParameters& parameters,
                                         const model::Motion& motion);

}  // namespace clackers::exact
