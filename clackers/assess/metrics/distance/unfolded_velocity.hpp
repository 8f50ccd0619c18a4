#pragma once

#include "clackers/assess/errors/comparison.hpp"
#include "clackers/assess/metrics/metric.hpp"

namespace clackers::assess {

/// max |(-1)^k v - (-1)^k* v*| [m/s] over the history's output times, mass by mass; k and k* count the
/// impacts of each motion so far. An impact that reverses every velocity disappears: the unfolded
/// true velocity is continuous, and a jump at a slightly wrong time costs no more than that time.
///
/// Defined where each impact reverses the velocity of every mass: one contact, restitution 1, and
/// v(+) = -v(-) at the true impacts, as where total momentum is zero at each (the synchronized
/// pairs) or one mass meets a rigid stop. Elsewhere, and without velocities, it is not measured.
///
/// Of two rows with one time the first stands before the impact, the second after it; a row alone
/// at the very time of an impact stands after it. A missed or extra collision turns the sign for
/// good, so that the error is of the size of the velocity.
///
/// Valid across jumps: yes. Not for contacts that last several rows (compliant contacts, impacts
/// spread over steps), where the velocity passes through zero.
/// Source: V. F. Zhuravlev's and A. P. Ivanov's non-smooth coordinate change.
MetricValue unfolded_velocity_error(const Comparison& comparison);

}  // namespace clackers::assess
