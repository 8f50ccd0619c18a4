#pragma once

#include <limits>
#include <string>
#include <vector>

namespace clackers::record {

/// A metric of one history.
struct MetricResult {
  std::string name, unit;
  double value = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> masses;  ///< mass by mass, empty for a metric of the whole structure
  std::string reason;          ///< why it was not measured
  /// false: it need not tend to zero for a history that converges, since its velocities jump.
  bool across_jumps = true;
};

}  // namespace clackers::record
