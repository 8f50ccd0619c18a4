#pragma once

#include <vector>

#include "clackers/diagnose/causes.hpp"

// The parts of ladder_causes().
namespace clackers::diagnose {

/// impact-at-step-end, impact-interpolated, impact-tolerance, contact-compliant: how the impacts of
/// all histories were located.
std::vector<Diagnosis> location_causes(const DiagnosisInput& question);
/// noise-floor.
std::vector<Diagnosis> noise_causes(const DiagnosisInput& question);
/// commensurate-steps, unstable-coarse-steps. `impacts_at_steps`: impact-at-step-end was found.
std::vector<Diagnosis> step_causes(const DiagnosisInput& question, bool impacts_at_steps);
/// contact-in-tension.
std::vector<Diagnosis> tension_causes(const DiagnosisInput& question);
/// force-step: what steps of all histories add to free motion.
std::vector<Diagnosis> force_causes(const DiagnosisInput& question);
/// event-interpolated, of ladders of tolerances.
std::vector<Diagnosis> event_causes(const DiagnosisInput& question);
/// numerical-damping, from the energies of the scores, where no histories are kept.
std::vector<Diagnosis> energy_causes(const DiagnosisInput& question);

}  // namespace clackers::diagnose
