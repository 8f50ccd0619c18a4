#pragma once

#include "clackers/assess/errors/comparison.hpp"
#include "clackers/study/record.hpp"

namespace clackers::study {

// Curves of a checked history for figures, one row a mass, at no more than most_points of its rows.

/// Displacements [m].
Curve displacement_curve(const assess::Comparison& comparison);

/// |Error in u| / initial envelope.
Curve error_curve(const assess::Comparison& comparison);

}  // namespace clackers::study
