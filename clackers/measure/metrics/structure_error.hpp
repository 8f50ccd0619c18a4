#pragma once

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/metric.hpp"

// Errors of the whole structure over the history's output times.
namespace clackers::measure {

/// v' M v / 2, u' K u / 2 or their sum.
enum class Energy { kinetic, potential, total };

/// max |E - E*| / H, H the largest total energy of the reference over the run; dimensionless; the
/// total is RunScore::energy_error. Not measured without velocities (the potential part is), with a
/// nonlinear force, whose potential is not known, or where H is not positive.
///
/// Valid across jumps: the potential part. The others jump where restitution is below 1, or where
/// an impact shifts kinetic energy between times at which the motions have and have not collided.
/// Source: common.
MetricValue energy_error(const Comparison& comparison, Energy energy);

/// max |p - p*| / P; p = sum over i of (M v)_i is the momentum, P = sum over i, j of |M_ij| V_j the
/// largest that the envelopes V of the true velocities allow (m_1 V_1 + m_2 V_2 for two masses).
/// Dimensionless. Not measured without velocities or where P is not positive.
///
/// Valid across jumps only between masses of the structure, whose impulses cancel; a stop outside
/// makes the momentum jump. Source: common.
MetricValue momentum_error(const Comparison& comparison);

/// max(0, -g) [m] over all contacts, g = b . u - gap, which the reference keeps at 0 or above. Not
/// measured without a contact.
///
/// Valid across jumps: yes, displacements do not jump. Source: common.
MetricValue penetration(const Comparison& comparison);

}  // namespace clackers::measure
