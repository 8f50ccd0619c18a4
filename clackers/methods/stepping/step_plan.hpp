#pragma once

#include <cmath>
#include <limits>
#include <string_view>

#include "clackers/methods/method.hpp"

namespace clackers::methods {

/// The instants of a run: start + k h for k = 0 ... whole, and the end. The end is one of them
/// when the run is a whole number of steps; otherwise the last step is a shorter one that ends on
/// it. A time is counted, never summed, and the last one is the end itself to the bit.
struct StepPlan {
  double start = 0.0, end = 0.0;  ///< [s]
  double h = 0.0;                 ///< [s]
  long long whole = 0;            ///< full steps
  long long total = 0;            ///< whole, plus one where a shorter step remains
  /// Of an adaptive integrator, which chooses the instants itself; NaN for all others. `h` is NaN
  /// then, and the numbers of steps have no end.
  double tolerance = std::numeric_limits<double>::quiet_NaN();

  bool is_adaptive() const { return !std::isnan(tolerance); }
  double time(long long k) const { return k == total ? end : start + double(k) * h; }
};

/// Lays out a run of `who`. Throws InputError for a step that is not positive and finite, is
/// longer than the run, is lost in the rounding of the times, or asks for more than 1e9 steps.
StepPlan plan_steps(std::string_view who, double start, double end, double h);

/// The smallest tolerance: below it rounding of a step hides its error.
inline constexpr double least_tolerance = 100.0 * std::numeric_limits<double>::epsilon();

/// The tolerance. Throws InputError unless least_tolerance <= tolerance < 1.
double require_tolerance(std::string_view who, double tolerance);

/// The plan of an adaptive run. Throws InputError as require_tolerance() does.
StepPlan plan_adaptive(std::string_view who, double start, double end, double tolerance);

/// The plan of a run of `method`, after the checks that Method::prepare() promises.
StepPlan checked_plan(const Method& method, const model::ImpactProblem<>& problem,
                      const Resolution& resolution);

}  // namespace clackers::methods
