#pragma once

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/metric.hpp"

// Distances after the jumps of both motions are undone.
namespace clackers::measure {

/// max |(-1)^k v - (-1)^k* v*| [m/s] over the history's output times, mass by mass; k and k* count
/// the impacts of each motion so far. An impact that reverses every velocity disappears: the
/// unfolded true velocity is continuous, and a jump at a slightly wrong time costs no more than
/// that time.
///
/// Defined where each impact reverses the velocity of every mass: one contact, restitution 1, and
/// v(+) = -v(-) at the true impacts, as where total momentum is zero at each (the synchronized
/// pairs) or one mass meets a rigid stop. Elsewhere, and without velocities, it is not measured.
///
/// Of two rows with one time the first stands before the impact, the second after it; a row alone
/// at the very time of an impact stands after it. A missed or extra impact turns the sign for
/// good, so that the error is of the size of the velocity.
///
/// Valid across jumps: yes. Not for contacts that last several rows (compliant contacts, impacts
/// spread over steps), where the velocity passes through zero.
/// Source: V. F. Zhuravlev's and A. P. Ivanov's non-smooth coordinate change.
MetricValue unfolded_velocity_error(const Comparison& comparison);

/// max over the history's output times of min(|x - y|, |J(x) - y|, |x - J(y)|), x the state (u, v)
/// of the history and y that of the reference. J is the impact map of a contact by Newton's law,
///
///     u -> u,   v -> v - (1 + eta) M^-1 b (b . v) / (b . M^-1 b),
///
/// tried for every contact; |.| is the largest difference of any mass in u / U and v / V, with U
/// and V the largest envelopes of the reference over the run. Dimensionless, of the whole structure.
///
/// J is tried at every time and not at impacts alone, so that it is never more than the plain
/// distance and forgives two states that differ by a whole impact wherever they are. Not measured
/// without velocities, without a contact or where an envelope is not positive.
///
/// Valid across jumps: yes; while one motion has jumped and the other has not, J takes one onto the
/// other. Not for contacts that last several rows.
/// Source: J. J. B. Biemond, N. van de Wouw, W. P. M. H. Heemels, H. Nijmeijer (2013).
MetricValue jump_invariant_distance(const Comparison& comparison);

}  // namespace clackers::measure
