#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "clackers/assess/errors/comparison.hpp"
#include "clackers/assess/metrics/distance/polyline_distance.hpp"
#include "clackers/assess/metrics/metric.hpp"

namespace clackers::assess {

/// The filled graph of a velocity: the set of (t/T, v/V) with vertical segments from the left limit
/// to the right one at jumps. T is collision_period(), V the mass's true envelope at t = 0. The
/// Hausdorff distance of two filled graphs, with points as far apart as the farther of their two
/// coordinates, tends to zero when jumps come slightly early or late, take two steps or are smeared
/// over a contact time; a distance of d says that neither graph leaves the other by more than d T
/// in time and d V in velocity at once. Where a history ends so near to an impact that it has it and
/// the reference has not, or the other way round, the graph that has it ends with its left limit: a last
/// impact within the last two steps that has no match does not count.
/// Source: J. J. Moreau, Approximation en graphe d'une evolution discontinue, RAIRO Anal. numer. 12,
/// 75-84 (1978).
///
/// Unless a chord is asked for, both graphs have their points at the same instants, the history's
/// rows, each also at its own jumps, and straight lines between them. What the lines cut off of the
/// curves is nearly the same on both sides, so the distance is that of the method and not of how
/// densely its rows were written; see chord_of_rows().
struct FilledGraphs {
  Polyline history, reference;
};

/// The graphs of one mass; needs has_velocities() and a positive envelope. Reported impacts of the
/// history with both limits are jumps of its graph. With a `chord` > 0 the reference has as many points
/// more as its true curve needs to stay within `chord` V of the lines: h^2/8 max |v''| <= chord V.
FilledGraphs filled_graphs(const Comparison& comparison, std::size_t mass, double chord = 0.0);

/// Bound on how far the true curve can be from straight lines between the history's rows, in
/// units of V: h^2/8 max |v''|, h the longest time between rows, |v''| as in jerk_bound(). NaN
/// where there is no such bound.
double chord_of_rows(const Comparison& comparison, std::size_t mass);

/// max |d2v/dt2| of a mass [m/s^3] in free flight: of M a' = -C a - K v with |a| and |v| at most
/// the envelopes at t = 0, which never grow. NaN for a system with a load or a nonlinear force.
double jerk_bound(const Comparison& comparison, std::size_t mass);

/// What keeps filled graphs from being compared, a sentence; empty if nothing does.
std::string objection_to_filled_graph(const Comparison& comparison);

/// The two-sided distance of the history's lines to the true curve itself, what is cut off between
/// rows included. The reference gets points until its own lines are within 1 % of the distance of the
/// curve, proved by the bound h^2/8 max |v''|, or `most_points` are used up.
struct CurveDistance {
  double value = 0.0;     ///< to the lines; to the curve it differs by at most `chord`
  double chord = 0.0;     ///< in units of V; NaN, as the value, where jerk_bound() is
  bool resolved = false;  ///< chord <= value / 100
};
CurveDistance distance_to_curve(const Comparison& comparison, std::size_t mass,
                                double most_points = 4e6);

/// Rows of the table of metrics: two-sided; from the history to the reference (what the history has and
/// the reference has not, such as spikes); from the reference to the history (what the history misses).
MetricValue measure_filled_graph(const Comparison& comparison);
MetricValue measure_filled_graph_of_history(const Comparison& comparison);
MetricValue measure_filled_graph_of_reference(const Comparison& comparison);

}  // namespace clackers::assess
