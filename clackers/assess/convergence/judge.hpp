#pragma once

#include "clackers/assess/convergence/assessment.hpp"
#include "clackers/assess/errors/score.hpp"
#include "clackers/base/judgement.hpp"

namespace clackers::assess {

/// Largest distance of a measured order from the claimed one, relative: of a line, and of an upper
/// envelope. The logarithm of the largest of eight errors that scatter evenly (in logarithms) by a
/// factor 30 has the standard deviation 0.099 ln 30 = 0.34; over eight levels of ratio 2 that gives
/// a slope one of 0.34 / (6.5 ln 2) = 0.075, and 0.25 is three of them.
inline constexpr double order_tolerance = 0.1;
inline constexpr double envelope_order_tolerance = 0.25;

/// A run that ends with less or more than these shares of the true energy has not followed the
/// motion, whatever its error relative to an envelope: beyond a factor 2 amplitudes are off by 0.29
/// of themselves at least.
inline constexpr double least_energy_ratio = 0.5, largest_energy_ratio = 2.0;

/// An envelope whose order is uncertain by more than this share of the claim decides nothing.
inline constexpr double envelope_spread = 0.5;

/// Judges a method by its ladder, coarsest level first, against its claim through impacts
/// (`undecided` claims nothing). `contact_time` [s] is that of a compliant contact, 0 for a rigid
/// one.
///
/// Behaviour and verdict go by the displacement error; velocity and impact times are fitted beside
/// it. Where displacements carry no line and most runs of both finest levels end with an energy
/// outside [1/2, 2] of the true one, the behaviour is `divergent`.
///
/// Verdict: `not claimed` without a claim; `undecided` where the behaviour is, where an exact
/// motion met a claim of some order (nothing above rounding to measure it on), and where the spread
/// of an envelope's order covers a claim beyond the tolerance; `agrees` where the behaviour is the
/// claimed one with an order within the tolerance above, or the claimed reason of a floor;
/// otherwise `disagrees`. A claim is two-sided: better than claimed is another behaviour and
/// disagrees as well. Collisions missed or extra on the two finest levels disagree whatever the
/// errors say, unless the claim is a floor and their number is right: then they came too late to be
/// matched.
Assessment judge(const Ladder& ladder, const Claim& claim, double contact_time);

}  // namespace clackers::assess
