#pragma once

#include <functional>
#include <span>
#include <vector>

#include "clackers/diagnose/system/fit_rows.hpp"
#include "clackers/diagnose/system/variation.hpp"

namespace clackers::diagnose {

/// Parameters that bring the motion nearest to a history.
struct SystemFit {
  std::vector<double> values;       ///< one a parameter; empty: not available
  double distance = 0.0;            ///< rms of what is left
  std::vector<double> uncertainty;  ///< half widths by the residual, as if it were noise
  std::vector<double> effect;       ///< rms that a unit of each makes of the rows; 0 for none
};

/// u - the motion of some values over the envelope, of the first rows; empty where it is not available.
using Residual =
    std::function<std::vector<double>(const std::vector<double>& values, std::size_t rows)>;

/// Gauss-Newton on exact simulations, first over the beginning of the history, then over windows of
/// twice the length, so that phases never wrap; then over all rows. `base` is changed already
/// where a hypothesis is more than its parameters. Steps are halved while they do not help.
SystemFit fit_system(const FitRows& rows, const Variation& base,
                     std::span<const Parameter> parameters);

/// The same of any motions, for values that are 0 in the case and count in units: 0.3 is a large change.
SystemFit fit_values(const FitRows& rows, const Residual& residual, std::vector<double> units,
                     double first_span);

/// The same over all rows at once, from values that are near already.
SystemFit refine_values(const FitRows& rows, const Residual& residual, std::vector<double> units,
                        const std::vector<double>& start);

/// The same over all rows at once, from values that are near already.
SystemFit refine_system(const FitRows& rows, const Variation& base,
                        std::span<const Parameter> parameters, std::vector<double> start);

}  // namespace clackers::diagnose
