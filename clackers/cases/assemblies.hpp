#pragma once

#include "clackers/cases/case.hpp"

namespace clackers::cases {

/// Builders of the cases with any number of masses: problem, motion, constants and periods from
/// `which.values`. Throw InputError for values outside their range.
void build_buildings(Case& which);
void build_row(Case& which);
void build_alternating(Case& which);
/// X = 4N + 1.
void build_assembly(Case& which, double X);

}  // namespace clackers::cases
