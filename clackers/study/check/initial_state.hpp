#pragma once

#include <string>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/diagnose/diagnose.hpp"

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

/// Refuses a history that starts from another state than the case (InputError). The message of file
/// `name` says the number that differs most, and why with its cure where that is found: parameters of
/// the case that start it so (not-this-case), or a cause of diagnose_start() with its code.
[[noreturn]] void refuse_start(const std::string& name, const diagnose::FirstRows& opening,
                               const cases::Case& problem, const StartDifference& most);

/// Refuses a history whose first row is after the start and shows units, signs or columns other than
/// the case's. Returns where nothing of that kind explains the row.
void refuse_reading(const std::string& name, const diagnose::FirstRows& opening,
                    const cases::Case& problem);

}  // namespace clackers::study
