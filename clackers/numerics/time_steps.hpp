#pragma once

#include <span>

namespace clackers::numerics {

/// The steps between times, those of length 0 left out.
struct TimeSteps {
  double median;  ///< the upper one
  double least, most;
};

/// Of times that ascend, two of them different.
TimeSteps time_steps(std::span<const double> times);

}  // namespace clackers::numerics
