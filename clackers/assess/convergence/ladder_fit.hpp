#pragma once

#include <span>

#include "clackers/assess/convergence/assessment.hpp"
#include "clackers/assess/convergence/error_ladder.hpp"

namespace clackers::assess {

/// What the fitter may know beside the errors.
struct FitContext {
  /// Order that the method claims; 0 or less when it claims none. Without a claim every straight
  /// converging line is `proper`, with the order it has.
  double claimed_order = 0.0;
  /// How long a compliant contact lasts [s], 0 for a rigid one: the cause of a floor.
  double contact_time = 0.0;
  /// The method states an iteration tolerance as the cause of its floor.
  bool states_tolerance = false;
  /// Errors as large as the motion itself say nothing of a floor: a flat ladder above this is one
  /// that does not converge yet. Infinite for an error that is not relative to the motion.
  double saturation = 1.0;
};

/// Steps that resolve a compliant contact divide its duration at least by this.
inline constexpr double steps_per_contact = 25.0;

/// A floor needs this many flat levels: two alone are what an error that passes through a minimum
/// shows.
inline constexpr int shortest_plateau = 3;

/// Rough levels are flat when their slope, with its uncertainty, lies between these. 32 points of a
/// scatter of 3 leave a slope a deviation of 0.07; the lower bound is wide since the scatter of a
/// chaotic floor may well rise.
inline constexpr double highest_flat_slope = 0.3, lowest_flat_slope = -0.5;

/// Growth whose finest rate is less than this share of the first one of its window settles.
inline constexpr double settling_share = 0.5;

/// What a ladder of errors says. The levels come coarsest first; the finest ones decide.
///
/// Levels in which most runs failed are left out at the coarse end (a stability limit) and make the
/// ladder `undecided` at the fine end. Then, over the finest consecutive levels above the rounding
/// floor:
///   exact       every level at the rounding floor;
///   proper      at least four levels, all rates of adjacent levels within 0.1 of the claimed order
///               (relative) and raw points within a factor 1.5 of the line. A straight line steeper
///               than claimed is proper too, with the order it has: the verdict compares;
///   reduced     the same with a lower slope, beyond its own spread, rates within 0.2 of it;
///   `undecided` while the finest
///               rates agree with the claim or still move towards it;
///   stagnating  at least three finest levels flat (rates within 0.2 of 0), or rough but flat;
///   irregular   raw points scatter further, from step to step or in swings over whole levels; the
///               line is that of the largest error of each level (leading levels with errors as
///               large as the motion left out), and its slope is positive beyond its own spread;
///   divergent   errors grow over the finest levels, without settling;
///   undecided   anything else, with the reason.
///
/// Throws InputError for steps that are not positive, for negative errors and for levels that do
/// not descend (view() of error_ladder.hpp says how).
LadderFit fit_ladder(std::span<const ErrorLevel> ladder, const FitContext& context);

}  // namespace clackers::assess
