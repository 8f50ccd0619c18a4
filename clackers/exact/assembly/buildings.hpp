#pragma once

#include <memory>
#include <string_view>

#include "clackers/exact/assembly/shaped_motion.hpp"
#include "clackers/model/impact_problem.hpp"

namespace clackers::exact {

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
