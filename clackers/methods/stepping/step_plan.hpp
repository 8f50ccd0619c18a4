#pragma once

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

  double time(long long k) const { return k == total ? end : start + double(k) * h; }
};

/// Lays out a run of `who`. Throws InputError for a step that is not positive and finite, is
/// longer than the run, is lost in the rounding of the times, or asks for more than 1e9 steps.
StepPlan plan_steps(std::string_view who, double start, double end, double h);

/// The plan of a run of `method`, after the checks that Method::prepare() promises.
StepPlan checked_plan(const Method& method, const model::ImpactProblem<>& problem,
                      const Resolution& resolution);

}  // namespace clackers::methods
