#include "clackers/methods/stepping/step_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"

namespace clackers::methods {

using model::most_steps;

StepPlan plan_steps(std::string_view who, double start, double end, double h) {
  require_step(who, h);
  const double length = end - start, ratio = length / h;
  const double nearest = std::round(ratio);
  // h may be rounded (length / n, or a decimal fraction), so are start and end, each by half a
  // unit of 2^-52, and so are length and ratio: less than four units together.
  const double eps = std::numeric_limits<double>::epsilon();
  const double scale = std::max({std::abs(start), std::abs(end), length}) / length;
  const bool is_whole = std::abs(ratio - nearest) <= 4.0 * eps * scale * ratio && nearest >= 1.0;
  if (!is_whole && h > length)
    refuse(who, "h", h, fmt::format("h <= {}, the length of the run in seconds", length),
           "Use a step that is not longer than the run.");
  if (!(ratio <= most_steps))
    refuse(who, "h", h, fmt::format("h >= {}, that is at most 1e9 steps", length / most_steps),
           "Use a larger step or an earlier end.", "too-many-steps");
  const double latest = std::max(std::abs(start), std::abs(end));
  if (!(h >= 4.0 * eps * latest))
    refuse(who, "h", h,
           fmt::format("h >= {}, or rounding of the times hides the steps", 4.0 * eps * latest),
           "Let the run start nearer to time 0.");
  StepPlan plan{start, end, h, static_cast<long long>(is_whole ? nearest : std::floor(ratio)), 0};
  plan.total = plan.whole + (is_whole ? 0 : 1);
  return plan;
}

double require_tolerance(std::string_view who, double tolerance) {
  if (!(tolerance > 0.0 && tolerance < 1.0))
    refuse(who, "tolerance", tolerance, "0 < tolerance < 1, the relative error of a step");
  if (!(tolerance >= least_tolerance))
    refuse(who, "tolerance", tolerance, fmt::format("tolerance >= {:.2g}", least_tolerance),
           "Rounding of a step is larger than a smaller one.", "tolerance-too-small");
  return tolerance;
}

StepPlan plan_adaptive(std::string_view who, double start, double end, double tolerance) {
  constexpr long long most = std::numeric_limits<long long>::max();
  return {.start = start,
          .end = end,
          .h = std::numeric_limits<double>::quiet_NaN(),
          .whole = most,
          .total = most,
          .tolerance = require_tolerance(who, tolerance)};
}

StepPlan checked_plan(const Method& method, const model::ImpactProblem<>& problem,
                      const Resolution& resolution) {
  const auto facts = method.facts();
  const auto& who = facts.name;
  if (resolution.is_tolerance() && !facts.is_adaptive)
    refuse(who, "tolerance", resolution.tolerance, "a step; it is not adaptive", {},
           "wrong-resolution");
  if (!resolution.is_tolerance() && facts.is_adaptive)
    refuse(who, "h", resolution.step, "a tolerance; it chooses its steps itself", {},
           "wrong-resolution");
  if (facts.is_adaptive)
    require_tolerance(who, resolution.tolerance);
  else
    require_step(who, resolution.step);
  model::validate(problem);
  if (const auto no = method.objection(problem)) throw InputError(no->sentence, no->code);
  if (facts.is_adaptive)
    return plan_adaptive(who, problem.start.t, problem.end, resolution.tolerance);
  return plan_steps(who, problem.start.t, problem.end, resolution.step);
}

}  // namespace clackers::methods
