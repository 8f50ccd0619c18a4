#pragma once

#include "clackers/base/judgement.hpp"
#include "clackers/judge/convergence/judge.hpp"
#include "clackers/judge/convergence/ladder_fit.hpp"

namespace clackers::judge {

/// What a fit says of a claim.
Verdict compare(const LadderFit& fit, const Claim& claim, const JudgeContext& facts);
/// In what it departs from a claim with which it disagrees, or which other evidence contradicts.
Mismatch mismatch_of(const LadderFit& fit, const Claim& claim, const JudgeContext& facts);

/// Whether its errors fall with an order, of a line or of an envelope.
bool shows_a_line(const LadderFit& fit);

/// Whether a claim not to converge, to diverge or nothing, has a reason.
inline bool explains_no_order(const Claim& claim) {
  return !claim.reason.empty() &&
         (claim.behaviour == Behaviour::undecided || claim.behaviour == Behaviour::divergent);
}

/// Whether errors are those of contacts of few steps, whose upper envelope falls while some are
/// resolved by chance, whatever floor follows.
bool is_above_floor(const LadderFit& fit, const JudgeContext& facts);
/// Whether the order of a line is that of its coarse range: errors not far below the motion itself,
/// which fall faster from level to level.
bool is_still_coarse(const LadderFit& fit);

}  // namespace clackers::judge
