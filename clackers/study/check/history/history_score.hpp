#pragma once

#include <vector>

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/errors/score.hpp"

namespace clackers::study {

/// The score of a stored history as a run would have it. Two rows of one time, and reported impacts
/// with velocities, are the limits of a jump; they count for u and v and are no states for the
/// energy. Masses without displacements (`has_u`) do not count; what needs them, or velocities that
/// the history lacks, is NaN. Impacts are left out. `step` [s] is the level's.
measure::RunScore history_score(const measure::Comparison& comparison,
                                const std::vector<bool>& has_u, double step);

}  // namespace clackers::study
