#pragma once

#include <span>

#include "clackers/judge/convergence/assessment.hpp"
#include "clackers/judge/convergence/fit/error_ladder.hpp"

namespace clackers::judge {

/// What the fit may know beside the errors.
struct FitContext {
  /// Order that the method claims; 0 or less when it claims none. Without a claim every straight
  /// converging line is `proper`, with the order it has.
  double claimed_order = 0.0;
  /// Largest distance of the rates from it, relative: an envelope is told less well than a line.
  double order_tolerance = 0.1;
  /// How long a compliant contact lasts [s], 0 for a rigid one: the cause of a floor.
  double contact_time = 0.0;
  /// The method states an iteration tolerance as the cause of its floor.
  bool states_tolerance = false;
  /// Errors as large as the motion itself show no floor: a flat ladder above this one does not
  /// converge yet. Infinite for an error that is not relative to the motion.
  double saturation = 1.0;
  /// Steps are tolerances of an adaptive solver.
  bool by_tolerance = false;
  /// The runs converge to another limit than the true motion, as their differences show.
  bool wrong_limit = false;
  /// A floor of these runs is noise, as their rows show; one run a level does not show it itself.
  bool noise = false;
};

/// Steps that resolve a compliant contact divide its duration at least by this.
inline constexpr double steps_per_contact = 25.0;
/// Steps of a contact that suffice where the error is flat to two digits.
inline constexpr double fewest_steps_per_contact = 10.0;

/// An error is proportional to the tolerance where its power of it is this near to 1.
inline constexpr double tolerance_proportional = 0.25;

/// A floor needs this many flat levels: two alone are what an error that passes through a minimum
/// shows.
inline constexpr int shortest_plateau = 3;

/// Rough levels are flat when their slope, with its uncertainty, lies between these. 32 points of a
/// scatter of 3 leave a slope a deviation of 0.07; the lower bound is wide since the scatter of a
/// chaotic floor may well rise.
inline constexpr double highest_flat_slope = 0.3;
/// No method converges, nor does rounding grow, with a smaller power of the step than this.
inline constexpr double lowest_real_order = 0.75;

/// Growth whose finest rate is less than this share of the first one of its window settles.
inline constexpr double settling_share = 0.5;

/// The behaviour that a ladder of errors shows, levels coarsest first. These rules are tried in
/// this order; the first that applies decides. `clear` levels are the consecutive finest ones above
/// the rounding floor in which at least half of the runs came to an end.
///
///  1 no level, or steps that do not resolve a compliant contact (unless flat to two digits over
///    three octaves with ten steps a contact: stagnating): undecided
///  2 most runs of the finest level failed: divergent if the errors before them grow, or undecided
///  3 every run of every level at the rounding floor, but for those there by coincidence: exact
///  4 a ladder of tolerances: by the line of all errors, scatter 10 allowed, and a floor after it
///  5 the claimed line over at least four levels, all rates of adjacent levels within a tenth of
///    the claimed order and raw points within a factor 1.5 of the line: proper
///  6 fewer than four clear levels: undecided
///  7 two terms of different sign follow the errors within 1.15: stagnating after a dip where the
///    lower one is a constant, else a line of the lower order (errors-cancel)
///  8 a straight line over at least four finest clear levels, rates within 0.2 of its slope:
///    a flat one (slope within 0.2 of 0): stagnating
///    one that may still reach the claim: as rule 10, 11 or 13, or undecided
///    one that grows: divergent; one below the claim: reduced; any other: proper, its own order
///  9 at least three finest clear levels flat: stagnating; proper above a rough floor
/// 10 the claimed line up to two levels before the floor, which rounding bends: proper
/// 11 a h^p + c follows the errors, of the finest levels better than a h^p + b h: proper or reduced with
///    a floor; stagnating where a smooth floor rules two octaves
/// 12 a line of three octaves, then a rough floor: proper or reduced with a floor
/// 13 raw points that zigzag from step to step: the envelope decides
/// 14 errors that grow over four levels without settling: divergent
/// 15 a straight line but for a few raw points far above it: the envelope decides
/// 16 errors that swing over whole levels: the envelope decides
/// 17 rates that exceed the claim and rise: undecided (no-fixed-order)
/// 18 errors that fall and then grow: undecided (error-grows-again)
/// 19 anything else: undecided: larger-than-motion, too-few-levels if the last rate is the claimed
///    one, one-sample-a-level, or no-convergence-yet
///
/// The envelope decides: undecided for one run a level; proper where the last three octaves are a line of
/// the claimed order; stagnating where the raw points of the last
/// four levels are flat; irregular where the line of the largest error of each level (leading levels
/// with errors as large as the motion left out) falls by more than its own spread; divergent where it
/// rises by as much; else undecided (more-samples).
///
/// Throws InputError for steps that are not positive, for negative errors and for levels that do
/// not descend (view() of error_ladder.hpp).
LadderFit fit_ladder(std::span<const ErrorLevel> ladder, const FitContext& context);

}  // namespace clackers::judge
