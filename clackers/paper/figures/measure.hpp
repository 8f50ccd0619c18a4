#pragma once

#include <string>

#include "clackers/cases/case.hpp"
#include "clackers/paper/figure.hpp"

namespace clackers::paper {

/// How far two curves with the same abscissae are apart at most. Throws std::logic_error for others.
double largest_difference(const Series& one, const Series& other);

/// Local maxima of a curve strictly inside (0, before).
int maxima(const Series& curve, double before);

/// A run of a method that knows nothing of the closed form, against it.
struct Integrated {
  double error = 0.0;  ///< largest displacement error of a mass, relative to its initial envelope
  long long found = 0, expected = 0;  ///< collisions up to the end
};

/// rk4 with located impacts and a step near `step` [s].
Integrated integrate(const std::string& case_name, const cases::Settings& settings, double step);
/// "rk4 with located impacts, step 0.001 s: largest error 1.2e-12, 6 of 6 collisions".
std::string words(const Integrated& run, double step);

/// A number in words of a claim: three significant digits, "2.2e-16".
std::string number(double value);

}  // namespace clackers::paper
