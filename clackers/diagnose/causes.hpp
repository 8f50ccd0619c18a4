#pragma once

#include <vector>

#include "clackers/diagnose/diagnose.hpp"

// The families of causes. Each returns the candidates that pass their own threshold, with
// confidence, gain and value; diagnose() compares them.
namespace clackers::diagnose {

/// Other parameters, times or impacts of the system, by exact simulation (system/).
std::vector<Diagnosis> system_causes(const DiagnosisInput& question);
/// What the numbers of single files show (file/).
std::vector<Diagnosis> file_causes(const DiagnosisInput& question);
/// What files of different steps show together (ladder/).
std::vector<Diagnosis> ladder_causes(const DiagnosisInput& question);

}  // namespace clackers::diagnose
