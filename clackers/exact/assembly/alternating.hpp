#pragma once

#include <memory>
#include <string_view>

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

}  // namespace clackers::exact
