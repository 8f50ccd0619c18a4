#include "clackers/judge/convergence/ladder_fit.hpp"

#include "clackers/judge/convergence/fit/rules.hpp"

namespace clackers::judge {
namespace {

// As numbered in the header.
constexpr Rule rules[] = {
    nothing_to_fit, finest_failed,    at_rounding_floor, tolerance_ladder,
    claimed_line,   too_few_levels,   cancellation,      other_line,
    plateau,        bent_by_rounding, line_with_floor,   line_then_rough_floor,
    zigzag,         growth,           outliers,          swinging,
    rising_rates,   grows_again,      anything_else};

}  // namespace

LadderFit fit_ladder(std::span<const ErrorLevel> ladder, const FitContext& context) {
  const auto range = range_of(ladder, context);
  for (const auto rule : rules)
    if (auto fit = rule(range, context)) return *std::move(fit);
  return range.blank;
}

}  // namespace clackers::judge
