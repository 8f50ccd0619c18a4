#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/distance/polyline_distance.hpp"
#include "clackers/measure/metrics/metric.hpp"

namespace clackers::measure {

/// A motion as a hybrid arc: one line for each flight j = 0, 1, ..., points (t/T, u/U, v/V) of all
/// masses, T as in Comparison::impact_period(), U and V the largest true envelopes. Flights do
/// not share their ends: the first ends with the left limits of an impact, the next starts with the
/// right ones. Flights are made one after another, so that one alone is in memory.
class HybridArc {
 public:
  /// Of the history, points at its rows and impacts. Its flights end and start at its own
  /// impacts; a row inside an impact that takes several steps belongs to no flight. Where the
  /// displacement or a limit of an impact is not known, its flights end with the last row before
  /// it and start with the first row after it. The comparison must outlive the arc.
  static HybridArc of_history(const Comparison& comparison);
  /// Of the reference, points at the history's rows and at its own impacts.
  static HybridArc of_reference(const Comparison& comparison);

  std::size_t flights() const { return impacts_.size() + 1; }
  /// The next flight, from the first one on; not more than there are.
  Polyline next();

 private:
  // Vectors are empty where its limits are not known.
  struct Jump {
    double from, to;  // [s]
    std::vector<double> u, before, after;

    bool is_known() const { return !u.empty() && !before.empty() && !after.empty(); }
  };

  HybridArc(const Comparison& comparison, std::span<const double> u, std::span<const double> v)
      : comparison_(comparison), u_(u), v_(v) {}
  bool is_inside(const Jump& impact, std::size_t row) const;
  bool is_before(const Jump& impact, std::size_t row) const;
  void put(Polyline& line, double t, std::span<const double> u, std::span<const double> v) const;

  const Comparison& comparison_;
  std::span<const double> u_, v_;  // at the history's rows
  std::vector<Jump> impacts_;
  std::size_t passed_ = 0, row_ = 0;  // impacts and rows in the flights so far
};

/// The smallest epsilon for which history and reference are (tau, epsilon)-close, tau the end of
/// the history: for every point (t, j) of the one there is an (s, j) of the other, j the same
/// number of impacts so far, with |t - s| <= epsilon T and each state within epsilon of its scale,
/// and the other way round. Both end with the history. Lines are joined as in filled_graphs(), and
/// the value is as close to the smallest one as one_sided_distance() is.
///
/// Stricter than the filled graph: impacts must come one for one, each a jump. Impacts at slightly
/// other instants do no harm; those that take two steps, and penalty contacts, which have no jump,
/// never become close. Not measured where the numbers of impacts differ, since then no epsilon is
/// large enough; an impact that only one of both has within the last two steps does not count.
/// Source: R. Goebel, R. G. Sanfelice, A. R. Teel, Hybrid Dynamical Systems, Princeton University
/// Press (2012), section 5.3.
MetricValue measure_hybrid_closeness(const Comparison& comparison);

}  // namespace clackers::measure
