#pragma once

#include <optional>
#include <vector>

#include "clackers/diagnose/diagnose.hpp"
#include "clackers/diagnose/ladder/impact_location.hpp"

// The parts of location_causes(), by the impacts that were located in each history.
namespace clackers::diagnose {

/// First steps without the acceleration at the start.
std::optional<Diagnosis> not_started(const DiagnosisInput& question);
/// Steps after impacts that go on with the acceleration before them.
std::optional<Diagnosis> not_renewed(const std::vector<LocatedImpacts>& files);
/// gap-differs, impact-at-step-end, impact-tolerance or impact-interpolated, by how late impacts come, or
/// not_renewed().
std::vector<Diagnosis> delay_causes(const DiagnosisInput& question,
                                    std::vector<LocatedImpacts> all);

}  // namespace clackers::diagnose
