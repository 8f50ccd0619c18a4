#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clackers::measure {

class Comparison;

/// What a metric found of one history.
struct MetricValue {
  /// The largest over masses unless the metric's definition says otherwise; NaN: not measured.
  double value = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> masses;  ///< mass by mass, empty for a metric of the whole structure
  std::string reason;          ///< why it was not measured, a sentence; empty when it was
};

/// A way to measure how far a history is from the reference: a row of the table `metrics()`.
///
/// Names are QUANTITY-MEASURE, or QUANTITY-MEASURE-relative where the value is divided by the scale
/// of the quantity and has no unit; lower case, words joined by hyphens. QUANTITY is what is
/// compared: u, v, a, energy, impact-time, period, ... MEASURE is how its error becomes a number:
/// max, l1, l2, end, count, fit (a least-squares line), or the name of a distance. In definitions a
/// star marks the reference; U and V are the largest envelopes of u* and v* over the run, T the time
/// between impacts.
struct Metric {
  std::string name;        ///< "u-max"
  std::string_view unit;   ///< "m", "m/s", "s", "1"
  std::string definition;  ///< the formula in one line
  /// Whether it tends to zero for every history that converges, though its velocities jump at
  /// slightly other instants than the true ones.
  bool across_jumps;
  std::string_view source;  ///< who defined it; "common" for norms
  bool in_reports;          ///< shown in reports by default
  std::function<MetricValue(const Comparison&)> measure;
};

/// All metrics, in the order of a report.
std::span<const Metric> metrics();

/// The metric of that name. Throws InputError with a suggestion for an unknown one.
const Metric& metric(std::string_view name);

/// A value of the whole structure. One that is NaN, because numbers of the history overflow, is not
/// measured.
MetricValue measured(double value);
/// One value a mass; the largest stands for all.
MetricValue measured(std::vector<double> masses);
/// Nothing, with the reason, a sentence.
MetricValue not_measured(std::string reason);
/// `value` divided mass by mass by an envelope; not measured where one is not positive.
MetricValue relative_to(const MetricValue& value, std::span<const double> envelope);

}  // namespace clackers::measure
