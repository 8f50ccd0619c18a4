#pragma once

#include <string>
#include <vector>

#include "clackers/cases/case.hpp"

namespace clackers::study {

/// The first row of a history. What it does not tell is NaN.
struct FirstRow {
  double t = 0.0;            ///< [s]
  std::vector<double> u, v;  ///< one entry a mass
};

/// Largest distance of the row from the reference at its time, relative to the initial envelopes of u
/// and v.
double start_error(const FirstRow& row, const cases::Case& which);

/// An initial state further than this from the case's, relative to the envelopes, is of another
/// motion: a method's own error is not in it, and what is left after printing four digits is
/// smaller.
inline constexpr double start_tolerance = 1e-3;

/// The sentences that refuse an initial state: which value differs most, the parameters that set
/// it, and the value of one parameter that would give the whole state, where there is one.
std::string other_start(const FirstRow& row, const cases::Case& which);

}  // namespace clackers::study
