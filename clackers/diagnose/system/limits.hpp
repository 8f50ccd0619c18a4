#pragma once

#include <optional>
#include <span>
#include <vector>

#include "clackers/diagnose/diagnosis.hpp"
#include "clackers/diagnose/system/fit_files.hpp"

namespace clackers::diagnose {

/// values = limit + constant h^order, orders 1 to 4 in halves.
struct PowerLimit {
  double limit = 0.0, order = 0.0;
  double residual = 0.0;  ///< largest distance of a value from the law
};

/// Nothing for fewer than three values.
std::optional<PowerLimit> power_limit(std::span<const double> steps,
                                      std::span<const double> values);

/// Frequencies and damping of the files' own fits: what of them remains at h -> 0 differs from the
/// case, what falls with a power of the step is the method's error of period.
std::vector<Diagnosis> smooth_limits(const FitQuestion& question);

}  // namespace clackers::diagnose
