#pragma once

#include <span>
#include <string>
#include <string_view>

#include "clackers/study/metric_result.hpp"

namespace clackers::report {

/// A table of metrics with units, definitions and sources, mass by mass; below it those that were
/// not measured with the reason. `of` names the run or the history, as text.
std::string metrics_table(std::span<const study::MetricResult> metrics, std::string_view of = {});

}  // namespace clackers::report
