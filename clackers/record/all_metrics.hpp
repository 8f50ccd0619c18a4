#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "clackers/measure/errors/comparison.hpp"
#include "clackers/record/record.hpp"

namespace clackers::record {

/// The facts of a run on a case. `contact_time` is half a period of a linear contact spring [s], 0: none
/// is known.
measure::RunFacts facts_of(const CaseSummary& summary, const model::ImpactProblem<>& problem,
                           double contact_time);

/// Called now and then with the share that is done, in [0, 1].
using MetricsDone = std::function<void(double share)>;

/// All metrics of a history, in the order of measure::metrics(). Nothing when `interrupt` becomes true.
std::optional<std::vector<MetricResult>> all_metrics(const measure::Comparison& comparison,
                                                     const MetricsDone& done = {},
                                                     const std::atomic<bool>* interrupt = nullptr);

}  // namespace clackers::record
