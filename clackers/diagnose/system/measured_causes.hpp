#pragma once

#include <optional>
#include <vector>

#include "clackers/diagnose/diagnose.hpp"

namespace clackers::diagnose {

/// Causes that histories with a wrong limit show row by row, for any number of masses and for loads:
/// no motion is fitted.
///
/// Flights: a row is moved to the next one by the case's own equations; what is missing there in
/// velocity is fitted by what a change of each stiffness, damper and mass, of each load and by a
/// constant force would make of it, one or two at once. Impacts: restitution and momentum as
/// locate_impacts() reads them. A cause has the same value in two histories of different steps; what
/// a method does falls with the step. Asked for where the errors stop, or are as large as the motion.
std::vector<Diagnosis> measured_causes(const DiagnosisInput& question);

/// The case's own motion at other times, of any system: by whole or half steps, or by one number of
/// seconds, in the two finest files.
std::optional<Diagnosis> shifted_time(const DiagnosisInput& question);

}  // namespace clackers::diagnose
