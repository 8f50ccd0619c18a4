#pragma once

#include <limits>
#include <optional>
#include <span>

#include "clackers/diagnose/observation.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::diagnose {

/// Where a history leaves the reference solution.
struct Departure {
  long long impact = 0;  ///< the last impact up to which it is right, from 1; 0: none
  double time = 0.0;     ///< of that impact, else of the first row that is wrong [s]
};

/// What histories of different steps converge to.
struct Limit {
  bool wrong = false;     ///< they converge, and not to the reference
  double distance = 0.0;  ///< largest |u - u*| over its envelope of the finest history's sample
  /// Largest rms difference between the finest history and those of at most twice its step, over
  /// the rms of its own error. It is 2^p - 1 for a method of order p, sqrt(2) for noise, and
  /// tends to 0 for a wrong limit. Infinite where nothing could be compared.
  double difference = std::numeric_limits<double>::infinity();
  double order = std::numeric_limits<double>::quiet_NaN();  ///< with which differences fall
  /// Where the error of the finest history exceeds a small part of its largest. Also known of one
  /// history, and of one whose limit is right.
  std::optional<Departure> departure;
  int files = 0;  ///< histories within eight times the finest step, the finest among them
};

/// Compares the errors of the histories as functions of time, coarsest history first. Errors are
/// interpolated, not displacements, by cubics in Hermite's form: of errors e of a motion of
/// frequency w, sampled every s seconds, that costs (w s)^4 / 384 of e, far less than what is asked
/// of the differences. Intervals with an impact are left out.
///
/// Never wrong: an error within ten times what printing, rounding or the reference's own bound
/// make of it; differences above a quarter of the error; few impacts applied at the same wrong row
/// of grids that contain each other. So noise, printed digits and the tolerance of a search for
/// impacts are no wrong limit: their differences are as large as their errors.
Limit limit_of(std::span<const Observation> histories, const model::ImpactProblem<>& problem,
               const model::Motion& motion);

}  // namespace clackers::diagnose
