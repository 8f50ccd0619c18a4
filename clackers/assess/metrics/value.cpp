#include "clackers/assess/metrics/value.hpp"

#include <fmt/format.h>

namespace clackers::assess {

MetricValue relative_to(const MetricValue& value, std::span<const double> envelope) {
  if (!value.reason.empty()) return value;
  auto masses = value.masses;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    if (!(envelope[i] > 0.0))
      return not_measured(fmt::format(
          "The true motion of mass {} has no extent at t = 0, so nothing is relative to it.",
          i + 1));
    masses[i] /= envelope[i];
  }
  return measured(std::move(masses));
}

}  // namespace clackers::assess
