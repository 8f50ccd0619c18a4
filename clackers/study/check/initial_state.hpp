#pragma once

#include <string>
#include <vector>

#include "clackers/cases/case.hpp"

namespace clackers::study {

/// The first row of a history. What it does not have is NaN.
struct FirstRow {
  double t = 0.0;            ///< [s]
  std::vector<double> u, v;  ///< one entry a mass
};

/// The number of a first row that differs most from the reference.
struct StartDifference {
  std::string name;  ///< "u1"; empty for a row without numbers
  double given = 0.0, expected = 0.0;
  double relative = 0.0;  ///< the difference over the largest envelope
};

StartDifference start_difference(const FirstRow& row, const cases::Case& problem);

/// An initial state further than this from the case's, relative to the envelopes, is of another
/// motion: a method's own error is not in it, and what is left after printing four digits is
/// smaller.
inline constexpr double start_tolerance = 1e-3;

}  // namespace clackers::study
