#include "clackers/study/metric_result.hpp"

#include <utility>

#include "clackers/assess/errors/comparison.hpp"
#include "clackers/assess/metrics/metric.hpp"

namespace clackers::study {

std::vector<MetricResult> metric_results(const assess::Comparison& comparison) {
  std::vector<MetricResult> all;
  for (const auto& metric : assess::metrics()) {
    auto found = metric.measure(comparison);
    all.push_back({std::string(metric.name), std::string(metric.unit), found.value,
                   std::move(found.masses), std::move(found.reason), metric.across_jumps});
  }
  return all;
}

}  // namespace clackers::study
