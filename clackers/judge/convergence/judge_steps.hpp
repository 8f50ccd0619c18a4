#pragma once

#include "clackers/judge/convergence/judge.hpp"
#include "clackers/judge/convergence/ladder_fit.hpp"

// The steps of judge().
namespace clackers::judge {

/// Whether errors stop falling without a cause in tolerances, contacts or digits.
bool is_unexplained_floor(const LadderFit& fit);

/// The fit of all displacement errors with the behaviour that the conditions after the rules of the
/// fit give, the first one that applies.
LadderFit behaviour_of(LadderFit fit, const measure::Ladder& ladder, const Claim& claim,
                       const JudgeContext& facts);

/// Sets verdict, its reason and the mismatch: those of the behaviour, overruled by what is more severe.
void decide(Assessment& found, const Claim& claim, const measure::Ladder& ladder,
            const JudgeContext& facts);

}  // namespace clackers::judge
