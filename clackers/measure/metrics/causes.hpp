#pragma once

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/metric.hpp"
#include "clackers/measure/metrics/penalty_split.hpp"

// Metrics that give a cause of a run's error, from Comparison::facts().
namespace clackers::measure {

/// Where synchrony is lost, and what part of it the method's own frequencies explain.
struct Synchrony {
  MetricValue lost, growth, detuning, predicted, share;
};
Synchrony explain_synchrony(const Comparison& comparison);

/// penalty_split() with the run's penalized motion, where it is known.
PenaltySplit split_known_penalty(const Comparison& comparison);

}  // namespace clackers::measure
