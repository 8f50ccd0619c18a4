#include "clackers/judge/convergence/step_ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"

namespace clackers::judge {
namespace {

constexpr auto step_ladder_name = "step ladder";

void validate(const RefinementPlan& plan, double end) {
  require_positive(step_ladder_name, "end", end);
  require_step(step_ladder_name, plan.coarsest);
  if (plan.coarsest > end)
    refuse(step_ladder_name, "coarsest", plan.coarsest,
           fmt::format("at most the length of the run, {} s", end), {}, "step-not-positive");
  if (plan.levels < 1) refuse(step_ladder_name, "levels", plan.levels, "1 or more");
  require_within(step_ladder_name, "samples per level", plan.samples_per_level, 1, 64);
  const double share = double(plan.samples_per_level - 1) / plan.samples_per_level;
  const double finest = plan.coarsest * std::exp2(-(plan.levels - 1 + share));
  if (!(end / finest <= most_steps))
    throw InputError(
        fmt::format("{}: the finest step of {} levels from coarsest = {} s is {:.3g} s "
                    "and a run to {} s would need {:.3g} steps; allowed: at most {:g}. "
                    "Use fewer levels or a larger coarsest step.",
                    step_ladder_name, plan.levels, plan.coarsest, finest, end, end / finest,
                    most_steps),
        "too-many-steps");
}

// Distance of t / h = t n / end from the nearest whole number, the least over all impacts.
double clearance(long long n, double end, std::span<const double> impact_times) {
  double least = 0.5;
  for (const double t : impact_times) {
    const double steps = t / end * double(n);
    least = std::min(least, std::abs(steps - std::round(steps)));
  }
  return least;
}

}  // namespace

std::vector<StepLevel> step_ladder(const RefinementPlan& plan, double end,
                                   std::span<const double> impact_times) {
  validate(plan, end);
  std::vector<double> inside;
  for (const double t : impact_times)
    if (t > 0.0 && t < end) inside.push_back(t);
  const double wanted_clearance = std::min(0.05, 0.25 / std::max(1.0, double(inside.size())));
  // A quarter of the way to the next step, so that steps keep their order and ratio.
  const double reach = 0.25 * (std::exp2(1.0 / plan.samples_per_level) - 1.0);
  // Far more numbers than are needed to find one that keeps away.
  constexpr long long most_tries = 1000;
  std::vector<StepLevel> ladder;
  long long previous = 0;
  for (int i = 0; i < plan.levels; ++i) {
    StepLevel level;
    level.nominal = plan.coarsest * std::exp2(-i);
    for (int j = 0; j < plan.samples_per_level; ++j) {
      const double wanted = end / level.nominal * std::exp2(double(j) / plan.samples_per_level);
      const auto nearest = std::max(1LL, std::llround(wanted));
      const auto width = std::min(most_tries, (long long)(reach * wanted));
      long long best = 0;
      double best_clearance = -1.0;
      for (long long k = 0; k <= 2 * width && best_clearance < wanted_clearance; ++k) {
        const long long n = nearest + (k % 2 == 0 ? -k / 2 : (k + 1) / 2);
        if (n <= previous) continue;
        const double found = clearance(n, end, inside);
        if (found > best_clearance) {
          best_clearance = found;
          best = n;
        }
      }
      if (best == 0) continue;
      previous = best;
      level.counts.push_back(best);
      level.steps.push_back(end / double(best));
    }
    ladder.push_back(level);
  }
  return ladder;
}

}  // namespace clackers::judge
