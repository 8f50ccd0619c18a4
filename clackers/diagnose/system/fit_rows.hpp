#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "clackers/diagnose/observation.hpp"
#include "clackers/diagnose/system/variation.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::diagnose {

/// The rows of a history that changed systems are fitted to: some of its opening and a selection of
/// its sample.
struct FitRows {
  std::vector<double> t;              ///< [s], ascending
  std::vector<double> u;              ///< of the history, row-major (time, mass), over the envelope
  std::vector<double> reference;      ///< the same of the reference
  std::vector<double> inverse_scale;  ///< 1 over the envelope, one a mass [1/m]
  double distance = 0.0;              ///< rms of u - reference
  /// What rounding, printing, and a change of the last digits of the system may make of it.
  double floor = 0.0;

  /// Whether the distance is 30 times the floor, and a number.
  bool is_far() const { return distance < 1e300 && distance > 30.0 * floor; }
  std::size_t dof() const { return inverse_scale.size(); }
  /// u - the motion of the variation, of the rows up to `rows`; empty where it is not available.
  /// Rows before the start of that motion are 0.
  std::vector<double> residual(const Variation& variation, std::size_t rows) const;
};

double rms(std::span<const double> values);

inline constexpr std::size_t most_fit_rows = 400, most_fit_opening_rows = 120;

/// The rows without what the system may make of `floor`, which is infinite where they are too few.
FitRows fit_rows(const Observation& observation, const model::Motion& motion);

/// Time of the first row where it has the state that the case starts with, as by a clock that starts
/// late; else 0.
double late_start(const Observation& observation, const model::Motion& motion);

/// `floor` is infinite where the simulation of the unchanged problem is not available.
FitRows fit_rows(const Observation& observation, const model::ImpactProblem<>& problem,
                 const model::Motion& motion);

}  // namespace clackers::diagnose
