#pragma once

#include <string>
#include <vector>

#include "clackers/measure/errors/comparison.hpp"

namespace clackers::measure {

/// A method's own frequencies in flight, as a history shows them.
struct FlightFrequencies {
  std::vector<double> errors;  ///< (omega_D found - omega_D)/omega_D, one a mass
  std::string reason;          ///< why they were not measured, a sentence
};

/// Adds up, over all intervals between rows of one flight, how far each mass turns in the plane (u,
/// (v + sigma u)/omega_D), in which free motion is a spiral of steady rate omega_D, and compares
/// with omega_D times the time. A method whose velocity has another scale turns unsteadily but
/// keeps its mean over half turns; flights that are reported with their limits start and end on
/// half turns of all masses. Not measured for coupled masses, loads, nonlinear forces, masses that
/// are not underdamped, and rows farther apart than a quarter of a fast period.
FlightFrequencies flight_frequencies(const Comparison& comparison);

/// eps of a pair with damped frequencies in the ratio X (1 + eps): what the faster mass turns too
/// fast beyond the slower one, (1 + error of the faster)/(1 + error of the slower) - 1. Throws
/// InputError unless there are two masses and their errors.
double detuning(const Comparison& comparison, const FlightFrequencies& found);

}  // namespace clackers::measure
