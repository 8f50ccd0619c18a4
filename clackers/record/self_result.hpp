#pragma once

#include <limits>
#include <span>
#include <vector>

#include "clackers/judge/convergence/richardson.hpp"
#include "clackers/judge/convergence/self_convergence.hpp"

namespace clackers::record {

/// What one would conclude of a method's runs without the true motion, beside what is true of the
/// same runs. Compared are the displacements at the end of each run, the one instant that runs of
/// all steps share, each divided by the largest envelope of its mass.
struct SelfResult {
  double order = 0.0;           ///< q that the differences are held to
  judge::SelfConvergence self;  ///< by differences between runs at successive steps
  judge::LadderFit errors;      ///< of the same values against the true ones
  judge::SelfAgainstReference against_reference;
  /// From the first run of each level.
  judge::Richardson extrapolation;
  /// Largest distance of the extrapolated values from the true ones; NaN where there is no bound.
  double extrapolation_error = std::numeric_limits<double>::quiet_NaN();
};

/// Assesses runs of one method, coarsest level first; values are relative, `exact` too. Levels with
/// fewer runs than the finest one are left out: their runs have no partner at the next step. Throws
/// InputError unless context.claimed_order > 0, and as judge::self_convergence does.
SelfResult self_result(std::vector<judge::ResponseLevel> runs, std::span<const double> exact,
                       const judge::SelfContext& context);

}  // namespace clackers::record
