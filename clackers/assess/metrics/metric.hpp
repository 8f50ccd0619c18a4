#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clackers::assess {

class Comparison;

/// What a metric found of one history.
struct MetricValue {
  /// The largest over masses unless the metric's definition says otherwise; NaN: not measured.
  double value = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> masses;  ///< mass by mass, empty for a metric of the whole structure
  std::string reason;          ///< why it was not measured, a sentence; empty when it was
};

/// A way to measure how far a history is from the reference: a row of the table `metrics()`.
struct Metric {
  std::string_view name;        ///< "u-max"
  std::string_view unit;        ///< "m", "m/s", "s", "1"
  std::string_view definition;  ///< one sentence, with the formula
  /// Whether it tends to zero for every history that converges, though its velocities jump at
  /// slightly other instants than the true ones.
  bool across_jumps;
  std::string_view source;  ///< who defined it; "common" for norms
  MetricValue (*measure)(const Comparison&);
};

/// All metrics, in the order of a report.
std::span<const Metric> metrics();

/// The metric of that name. Throws InputError with a suggestion for an unknown one.
const Metric& metric(std::string_view name);

}  // namespace clackers::assess
