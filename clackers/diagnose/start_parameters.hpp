#pragma once

#include <vector>

#include "clackers/diagnose/diagnose.hpp"

namespace clackers::diagnose {

/// The one parameter, or else the two, that make the first row of a history the start of the case,
/// to 1e-6 of the envelope or its printed digits; empty where none do, where the row is at t > 0,
/// and where diagnose_start() has a cause that explains the rows of the first flight better (a start
/// at rest is no proof of no damping) or as well (units, exchanges, signs). The parameters of `family`
/// are the likeliest first: of several that explain the start the first ones are taken. Values are rounded to the fewest digits that still match.
///
/// Searched by Gauss-Newton steps from a few sizes of each value; a parameter that takes whole
/// numbers alone from 0 to 50. About 100 calls of `motion_of` a pair of parameters.
std::vector<CaseParameter> start_parameters(const FirstRows& opening,
                                            const model::ImpactProblem<>& problem,
                                            const model::Motion& motion, const CaseFamily& family);

}  // namespace clackers::diagnose
