#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "clackers/exact/assembly/shaped_motion.hpp"
#include "clackers/model/impact_problem.hpp"

namespace clackers::exact {

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
