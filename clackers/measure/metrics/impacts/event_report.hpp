#pragma once

#include <limits>
#include <vector>

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/metrics/metric.hpp"

namespace clackers::measure {

/// One impact of the history against the true one it belongs to.
struct ImpactError {
  long long index = 0;      ///< of the true impact, 1 for the first
  std::size_t found = 0;    ///< index into Comparison::impacts()
  double t = 0.0;           ///< of the history's impact [s]
  double time_error = 0.0;  ///< found minus true [s]
  /// |v - v*| just before and just after, mass by mass [m/s]; empty where not known.
  std::vector<double> before, after;
  /// |P - P*| along the contact's direction [N s]; NaN where not known.
  double impulse = std::numeric_limits<double>::quiet_NaN();
  bool late = false;  ///< found more than one step of the history after the true instant
};

/// Impact k against k.
struct EventReport {
  ImpactSource source = ImpactSource::reported;
  long long expected = 0, found = 0, matched = 0, missed = 0, extra = 0;
  long long late = 0;                ///< of the matched
  std::vector<ImpactError> impacts;  ///< the matched ones in order of time
};

/// Times, velocities on both sides and impulses are compared at the impacts themselves, each
/// motion at its own instant, so all of it is valid across jumps: an impact found at t* + d has
/// the right velocities up to O(d). Pairs and counts follow ImpactMatcher's rule; a step is
/// Comparison::step(). Source: common.
EventReport event_report(const Comparison& comparison);

/// The worst of all matched impacts. Not measured where none is matched, or where what is asked
/// for is known of none.
MetricValue impact_time_error(const Comparison& comparison);      ///< max |t - t*| [s]
MetricValue velocity_before_error(const Comparison& comparison);  ///< [m/s], mass by mass
MetricValue velocity_after_error(const Comparison& comparison);   ///< [m/s], mass by mass
MetricValue impulse_error(const Comparison& comparison);          ///< [N s]

/// Counts; `late` does not tend to zero for a method that always fires two steps late, though the
/// method converges.
MetricValue missed_impacts(const Comparison& comparison);
MetricValue extra_impacts(const Comparison& comparison);
MetricValue late_impacts(const Comparison& comparison);

}  // namespace clackers::measure
