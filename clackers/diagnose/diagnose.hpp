#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clackers/assess/convergence/assessment.hpp"
#include "clackers/assess/convergence/self_convergence.hpp"
#include "clackers/diagnose/diagnosis.hpp"
#include "clackers/diagnose/observation.hpp"

namespace clackers::diagnose {

/// All that a cause may be looked for in.
struct Question {
  const model::ImpactProblem<>& problem;
  const model::Motion& motion;
  /// The finished histories, coarsest first; empty for a method whose runs are not stored.
  std::span<const Observation> histories;
  const assess::Ladder& ladder;           ///< all runs, failed ones as well
  const assess::LadderFit& displacement;  ///< the fit of their errors
  const assess::LadderFit& velocity;
  /// Of the histories at common times, where there are enough of them; nullptr otherwise.
  const assess::LadderFit* differences = nullptr;
  bool by_tolerance = false;  ///< the ladder is of tolerances, not of steps
};

/// The causes that explain the histories, strongest first, each at most once; empty for a correct
/// solver whose steps are fine.
std::vector<Diagnosis> diagnose(const Question& question);

/// The rows at the start of a history that is refused, or not yet compared.
struct Opening {
  double step = 0.0;        ///< [s], 0 where it is not known
  model::Trajectory rows;   ///< as read; `v` may be empty
  std::vector<bool> has_u;  ///< one entry a mass
  double printed_floor = 0.0;
};

/// Why a history starts from another state than the case: units, exchanged columns or masses, signs,
/// a start at rest, velocities of half steps. Nothing where none of these explains it.
std::optional<Diagnosis> diagnose_start(const Opening& opening,
                                        const model::ImpactProblem<>& problem,
                                        const model::Motion& motion);

}  // namespace clackers::diagnose
