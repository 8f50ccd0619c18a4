#pragma once

#include <optional>

#include "clackers/diagnose/diagnose.hpp"

// Whether the histories are a ladder at all, before anything is fitted to them.
namespace clackers::diagnose {

/// steps-contradict-rows, fixed-internal-step, step-without-effect; nothing for a ladder.
std::optional<Diagnosis> no_ladder(const DiagnosisInput& question);

/// The one run whose error lies far above the line through those of all others; none of the coarsest step.
struct OddRun {
  std::size_t level = 0, run = 0;
  Diagnosis found;
};
std::optional<OddRun> odd_run(const measure::Ladder& ladder, bool by_tolerance = false);

}  // namespace clackers::diagnose
