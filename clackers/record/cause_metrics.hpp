#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/record/metric_result.hpp"
#include "clackers/record/record.hpp"

namespace clackers::record {

/// A number that gives a cause of a run's error. Unlike measure::Metric it needs more than history and reference.
struct CauseMetric {
  std::string_view name, unit, definition, source;
};

/// All of them, in the order of cause_results().
std::span<const CauseMetric> cause_metrics();

/// What is known of a case, and of the method on it.
struct RunFacts {
  /// Growth of a disturbance per collision and unit of detuning; 0 where none grows or the case is
  /// no pair. The constant "detuning_rate" of the case.
  double detuning_rate = 0.0;
  double contact_time = 0.0;  ///< half a period of a linear contact spring [s], 0: none is known
};

RunFacts facts_of(const CaseSummary& problem, double contact_time);

/// Where synchrony is lost and what part of it the method's own frequencies explain; what part of an
/// error is the contact spring's and what part the integration's.
std::vector<MetricResult> cause_results(const measure::Comparison& comparison,
                                        const RunFacts& facts);

/// Called now and then with the share that is done, in [0, 1].
using MetricsDone = std::function<void(double share)>;

/// All metrics of a history, in the order of measure::metrics(), then cause_results(). Nothing when
/// `interrupt` becomes true.
std::optional<std::vector<MetricResult>> all_metrics(const measure::Comparison& comparison,
                                                     const RunFacts& facts,
                                                     const MetricsDone& done = {},
                                                     const std::atomic<bool>* interrupt = nullptr);

}  // namespace clackers::record
