#pragma once

#include "clackers/assess/errors/comparison.hpp"
#include "clackers/assess/metrics/metric.hpp"

namespace clackers::assess {

/// max over the history's output times of min(|x - y|, |J(x) - y|, |x - J(y)|), x the state (u, v) of
/// the history and y that of the reference. J is the impact map of a contact by Newton's law,
///
///     u -> u,   v -> v - (1 + eta) M^-1 b (b . v) / (b . M^-1 b),
///
/// tried for every contact; |.| is the largest difference of any mass in u / U and v / V, with U
/// and V the envelopes of the reference at t = 0. Dimensionless, of the whole structure.
///
/// J is tried at every time and not at impacts alone, so that it is never more than the plain
/// distance and forgives two states that differ by a whole impact wherever they are. Not measured
/// without velocities, without a contact or where an envelope is not positive.
///
/// Valid across jumps: yes; while one motion has jumped and the other has not, J takes one onto the
/// other. Not for contacts that last several rows.
/// Source: J. J. B. Biemond, N. van de Wouw, W. P. M. H. Heemels, H. Nijmeijer (2013).
MetricValue jump_invariant_distance(const Comparison& comparison);

}  // namespace clackers::assess
