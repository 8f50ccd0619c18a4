#pragma once

#include <cstddef>

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/distance/polyline_distance.hpp"
#include "clackers/measure/metrics/metric.hpp"

namespace clackers::measure {

/// The filled graph of a velocity: the set of (t/T, v/V) with vertical segments from the left limit
/// to the right one at jumps. T is Comparison::impact_period(), V the mass's true envelope at t
/// = 0. The Hausdorff distance of two filled graphs, with points as far apart as the farther of
/// their two coordinates, tends to zero when jumps come slightly early or late, take two steps or
/// are smeared over a contact time; a distance of d says that neither graph leaves the other by
/// more than d T in time and d V in velocity at once. Where a history ends so near to an impact
/// that it has it and the reference has not, or the other way round, the graph that has it ends
/// with its left limit: a last impact within the last two steps that has no match does not count.
/// Source: J. J. Moreau, Approximation en graphe d'une evolution discontinue, RAIRO Anal. numer.
/// 12, 75-84 (1978).
///
/// Both graphs have their points at the same instants, the history's rows, each also at its own
/// jumps, and straight lines between them. What the lines cut off of the curves is nearly the same
/// on both sides, so the distance is that of the method and not of how densely its rows were
/// written.
struct FilledGraphs {
  Polyline history, reference;
};

/// The graphs of one mass; needs has_velocities() and a positive envelope. Reported impacts of the
/// history with both limits are jumps of its graph.
FilledGraphs filled_graphs(const Comparison& comparison, std::size_t mass);

/// Rows of the table of metrics: two-sided; from the history to the reference (what the history has
/// and the reference has not, such as spikes); from the reference to the history (what the history
/// misses). Not measured without velocities, where an envelope is not positive, where rows are far
/// fewer than true impacts, and where the graphs are too far apart for the search.
MetricValue measure_filled_graph(const Comparison& comparison);
MetricValue measure_filled_graph_of_history(const Comparison& comparison);
MetricValue measure_filled_graph_of_reference(const Comparison& comparison);

}  // namespace clackers::measure
