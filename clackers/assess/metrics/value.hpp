#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "clackers/assess/metrics/metric.hpp"

// How a metric makes its MetricValue.
namespace clackers::assess {

/// A value of the whole structure.
inline MetricValue measured(double value) { return {value, {}, {}}; }

/// One value a mass; the largest stands for all.
inline MetricValue measured(std::vector<double> masses) {
  const double largest = *std::ranges::max_element(masses);
  return {largest, std::move(masses), {}};
}

/// Nothing, with the reason, a sentence.
inline MetricValue not_measured(std::string reason) {
  MetricValue nothing;
  nothing.reason = std::move(reason);
  return nothing;
}

/// `value` divided mass by mass by an envelope; not measured where one is not positive.
MetricValue relative_to(const MetricValue& value, std::span<const double> envelope);

}  // namespace clackers::assess
