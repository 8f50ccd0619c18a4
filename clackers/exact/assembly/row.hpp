#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "clackers/exact/assembly/shaped_motion.hpp"
#include "clackers/model/impact_problem.hpp"

namespace clackers::exact {

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

}  // namespace clackers::exact
