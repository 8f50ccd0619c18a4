#pragma once

#include <vector>

#include "clackers/assess/errors/score.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::study {

/// A stored history through the scorer of runs, a block at a time. Two rows of one time, and impacts
/// that are reported with velocities, are jumps. Masses without displacements, and a history without
/// velocities, leave no trace in the errors of the others; what needs them is NaN. Impacts are not
/// matched. `step` [s] is the level's.
assess::RunScore score_history(const model::Trajectory& history, const std::vector<bool>& has_u,
                               double step, const model::Motion& reference,
                               const model::ImpactProblem<>& problem);

}  // namespace clackers::study
