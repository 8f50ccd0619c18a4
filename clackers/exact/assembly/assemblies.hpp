#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "clackers/exact/assembly/shaped_motion.hpp"
#include "clackers/model/impact_problem.hpp"

namespace clackers::exact {

/// r*(2 rh), the limit of r: the function of admissibility.hpp at an even ratio.
double alternating_limit(double rh);

/// Throws InputError for parameters outside their ranges, and (not-admissible) for an r with which
/// the middle mass would touch a partner between impacts.
std::unique_ptr<const ShapedMotion> make_alternating(const AlternatingParameters& parameters,
                                                     std::string_view who = "alternating");

/// What a method is given.
model::ImpactProblem<> alternating_problem(const AlternatingParameters& parameters,
                                           const model::Motion& motion);

/// One mass of the row.
struct RowMass {
  double mass = 1.0;      ///< [kg]
  double multiple = 1.0;  ///< of Omega
  double velocity = 1.0;  ///< just after an impact, with E = 1 [m/s]
};
std::vector<RowMass> row_masses(const RowParameters& parameters);

/// The limit of `speed`: 1 for a fast mass between slow ones, r*(X) for the first or the last one.
double row_limit(const RowParameters& parameters);

/// Throws InputError for parameters outside their ranges, for a row whose problem is too large, and
/// (not-admissible) for a speed with which the fast mass would touch a neighbour away from equilibrium.
std::unique_ptr<const ShapedMotion> make_row(const RowParameters& parameters,
                                             std::string_view who = "row");

/// What a method is given.
model::ImpactProblem<> row_problem(const RowParameters& parameters, const model::Motion& motion);

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
