#pragma once

#include "clackers/assess/convergence/window.hpp"

// Where the rates of a window are heading, coarse to fine.
namespace clackers::assess {

/// A rate that moves by more than this from level to level moves for a reason: scatter within
/// `straight_scatter` at eight steps a level leaves a rate an error of 0.02.
inline constexpr double least_move = 0.04;
/// Smaller moves count where the scatter of the raw points makes an error in the rates this many
/// times smaller.
inline constexpr double significant_move = 3.0;

/// Whether a line of another slope than claimed might be the bend in front of the claimed one: its
/// slope, by as much as its 95 % confidence interval, or its finest rate lies within a tenth of the
/// claim; or its last three rates move towards the claim by more than `least_move` each, or by less
/// but significantly and so that their limit (Aitken's) lies within that tenth. So h |ln h| is
/// still on its way to order 1. `claimed` <= 0 is no claim. Needs three rates.
bool may_still_reach(double claimed, const Window& found);

/// Whether the last three rates exceed the claim and rise, each by more than `straight_rates`: an
/// error faster than any power of the step, or one before a line of higher order.
bool rates_rise(double claimed, const Window& found);

/// How far the finest rate lies from the slope where all rates move one way, otherwise 0: a
/// confidence interval of the slope knows nothing of such a bend.
double drift(const Window& found);

}  // namespace clackers::assess
