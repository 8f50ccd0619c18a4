#pragma once

#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::measure {

/// Throws InputError unless the history can be compared with the reference: both and the problem
/// have the same number of masses, all lists have the size that its times ask for (velocities may
/// be missing, accelerations too), there are at least two different times, numbers are finite,
/// times do not descend and lie within [0, reference.end()], and at most two rows share a time. A
/// time may pass the end by the rounding of a product and a sum, 4 units of 2^-52 of it.
void require_comparable(const model::Trajectory& history, const model::Motion& reference,
                        const model::ImpactProblem<>& problem);

/// The largest time that passes for the end of the motion [s].
double latest_time(const model::Motion& reference);

}  // namespace clackers::measure
