#pragma once

#include <optional>

#include "clackers/judge/convergence/fit/range.hpp"

// The rules of fit_ladder (ladder_fit.hpp), by what they look at. Each returns nothing where it does
// not apply.
namespace clackers::judge {

using Rule = std::optional<LadderFit> (*)(const Range&, const FitContext&);
using RuleResult = std::optional<LadderFit>;

// Runs: run_rules.cpp
RuleResult nothing_to_fit(const Range& range, const FitContext& context);
RuleResult finest_failed(const Range& range, const FitContext& context);
RuleResult at_rounding_floor(const Range& range, const FitContext& context);
RuleResult too_few_levels(const Range& range, const FitContext& context);
RuleResult anything_else(const Range& range, const FitContext& context);

// Lines: line_rules.cpp
RuleResult claimed_line(const Range& range, const FitContext& context);
RuleResult other_line(const Range& range, const FitContext& context);
RuleResult bent_by_rounding(const Range& range, const FitContext& context);
RuleResult rising_rates(const Range& range, const FitContext& context);
RuleResult growth(const Range& range, const FitContext& context);

// Floors: floor_rules.cpp
RuleResult plateau(const Range& range, const FitContext& context);
RuleResult line_with_floor(const Range& range, const FitContext& context);
RuleResult line_then_rough_floor(const Range& range, const FitContext& context);
/// A floor of the levels of a flat window; undecided where it is as large as the motion.
LadderFit stagnates(const Range& range, const FitContext& context, const Window& flat);

// Errors that pass zero: cancellation_rules.cpp
RuleResult cancellation(const Range& range, const FitContext& context);
RuleResult grows_again(const Range& range, const FitContext& context);

// Scatter: scatter_rules.cpp
RuleResult zigzag(const Range& range, const FitContext& context);
RuleResult outliers(const Range& range, const FitContext& context);
RuleResult swinging(const Range& range, const FitContext& context);

// Tolerances: tolerance_rules.cpp
RuleResult tolerance_ladder(const Range& range, const FitContext& context);

}  // namespace clackers::judge
