#pragma once

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/metric.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::measure {

/// The error of a run with compliant contacts in two parts: what its model is wrong by, and what
/// its integration is. `penalized` is the exact motion with the run's own contact springs.
///
/// - u: max over the history's times of the distance / largest envelope of the true u
/// - v: integral over time of the distance, by the trapezoidal rule over the history's rows, over
///   the length of the history and the largest envelope of the true v
///
/// mass by mass. Total error <= model + integration, by the triangle inequality. Valid across
/// jumps: u and the integral of v are; the history and the penalized motion do not jump at all.
struct PenaltySplit {
  MetricValue model_u;        ///< |penalized - rigid|
  MetricValue integration_u;  ///< |history - penalized|
  MetricValue model_v, integration_v;
};

/// Throws InputError unless `penalized` has the comparison's number of masses and lasts as long as
/// the history (give or take a rounding).
PenaltySplit penalty_split(const Comparison& comparison, const model::Motion& penalized);

}  // namespace clackers::measure
