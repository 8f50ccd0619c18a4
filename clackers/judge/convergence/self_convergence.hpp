#pragma once

#include <span>
#include <string>
#include <vector>

#include "clackers/judge/convergence/assessment.hpp"

// Convergence assessed from the runs alone, by the differences between runs at successive steps, and
// beside it what the true motion says of the same runs.
namespace clackers::judge {

/// What one run says at times that all runs share (the end of the run, or a common output grid).
struct Response {
  double step = 0.0;           ///< h > 0 [s]
  std::vector<double> values;  ///< in one unit; empty or not finite for a run that failed
  double floor = 0.0;          ///< what rounding or printing alone may make of a value, >= 0
};

/// Runs of neighbouring steps. Run k of a level is compared with run k of the next level.
using ResponseLevel = std::vector<Response>;

/// What may be known of runs beside their values.
struct SelfContext {
  double claimed_order = 0.0;  ///< q; 0 or less when none is claimed
  double size = 1.0;           ///< of the motion, in the unit of the values; differences over it
  double contact_time = 0.0;   ///< of a compliant contact [s], 0 for a rigid one
};

/// What the runs say of themselves.
struct SelfConvergence {
  /// Of the pseudo errors  max |U_{j+1} - U_j| / (r^q - 1) / size  against the finer step h_{j+1},
  /// r = h_j / h_{j+1}; without a claim of the differences themselves. Level j compares levels j
  /// and j + 1 of the runs.
  LadderFit differences;
  /// The pseudo errors fall at the claimed order, within `order_tolerance`, over at least four
  /// levels: proper convergence, to whatever limit.
  bool proper = false;
  /// The pseudo error of the finest level of their line, NaN without one: where the sequence is
  /// proper and its limit the true motion, the error of the finer run is at most twice this.
  double estimate = 0.0;
};

/// Judges runs by their differences, coarsest level first. Five levels are the least: four
/// differences. The pseudo error of a proper sequence is the error of its finer run, since
/// U_{j+1} - U_j = C h_{j+1}^q (1 - r^q) to leading order; this holds for any ratios of the steps.
///
/// Throws InputError for levels of different numbers of runs, runs of different numbers of values,
/// steps that do not descend, size or floors out of range, and, without a claimed order, for ratios
/// of the steps that differ by more than 1 % (differences of uneven steps are no power of h).
///
/// Sources: proper convergence and pseudo convergence are A. Soroushian's terms (4th IC-SCCE, Athens
/// 2010; A. Soroushian, P. Wriggers, J. Farjoodi, Int. J. Numer. Meth. Eng. 80, 565-595, 2009, and
/// J. Eng. Mech. ASCE 139, 114-145, 2013); the formulas are derived here from the expansion.
SelfConvergence self_convergence(std::span<const ResponseLevel> runs, const SelfContext& context);

/// The fit of the errors of the same runs in the same norm, max |U - exact| / size. Throws
/// InputError as self_convergence does, and for another number of exact values.
LadderFit true_convergence(std::span<const ResponseLevel> runs, std::span<const double> exact,
                           const SelfContext& context);

/// A true error above this many pseudo errors contradicts them: where successive differences shrink
/// by r^-q within the departure that extrapolation allows (richardson.hpp), the error is at most
/// twice the pseudo error.
inline constexpr double trust_factor = 2.0;

/// What the differences promise, compared with the reference solution.
struct SelfAgainstReference {
  bool false_convergence = false;  ///< the differences promise what the errors do not keep
  std::string reason;        ///< "wrong-limit" where the errors stop and the differences do not
  double error_ratio = 0.0;  ///< true error over pseudo error at `estimate`; NaN without both
};

/// Compares what the differences say with the errors of the same runs (true_convergence).
SelfAgainstReference compare(const SelfConvergence& self, const LadderFit& reference);

}  // namespace clackers::judge
