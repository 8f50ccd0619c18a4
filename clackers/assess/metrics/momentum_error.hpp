#pragma once

#include "clackers/assess/errors/comparison.hpp"
#include "clackers/assess/metrics/metric.hpp"

namespace clackers::assess {

/// max |p - p*| / P over the history's own times; p = sum over i of (M v)_i is the momentum of the
/// whole structure, P = sum over i, j of |M_ij| V_j the largest that the envelopes V of the true
/// velocities at t = 0 allow (m_1 V_1 + m_2 V_2 for two masses). Dimensionless. Not measured
/// without velocities or where P is not positive.
///
/// Valid across jumps only between masses of the structure, whose impulses cancel; a stop outside
/// makes the momentum jump. Source: common.
MetricValue momentum_error(const Comparison& comparison);

}  // namespace clackers::assess
