#pragma once

#include "clackers/assess/errors/comparison.hpp"
#include "clackers/assess/metrics/metric.hpp"

namespace clackers::assess {

/// v' M v / 2, u' K u / 2 or their sum.
enum class Energy { kinetic, potential, total };

/// max |E - E*| / H over the history's own times, H the total energy of the true motion at t = 0;
/// dimensionless, of the whole structure. Not measured without velocities (the potential part is),
/// with a nonlinear force, whose potential is not known, or where H is not positive.
///
/// Valid across jumps: the potential part. The others jump where restitution is below 1, or where
/// an impact shifts kinetic energy between times at which the motions have and have not collided.
/// Source: common.
MetricValue energy_error(const Comparison& comparison, Energy energy);

}  // namespace clackers::assess
