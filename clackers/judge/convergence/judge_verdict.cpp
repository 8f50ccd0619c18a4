#include <algorithm>
#include <array>

#include "clackers/base/codes.hpp"
#include "clackers/judge/convergence/claim_comparison.hpp"
#include "clackers/judge/convergence/judge_steps.hpp"

namespace clackers::judge {
namespace {

// Whether displacements converge faster than a claim that stands: velocities are as claimed, whose errors
// cancel in their integral, or no impact happens, of which irregular convergence is claimed.
bool is_more_than_claimed(const Assessment& found, const Claim& claim,
                          const measure::Ladder& ladder, const JudgeContext& facts) {
  const auto& fit = found.displacement;
  if (found.verdict != Verdict::disagrees || !shows_a_line(fit) || !(claim.order > 0.0) ||
      !(fit.order > claim.order) || claim.velocity_order > 0.0)
    return false;
  const auto& impacts = finest_run(ladder).impacts;
  const bool of_no_impact =
      claim.behaviour == Behaviour::irregular && impacts && impacts->expected == 0;
  return of_no_impact || compare(found.velocity, claim, facts) == Verdict::agrees;
}

int severity(Verdict verdict) {
  constexpr std::array order{Verdict::not_claimed, Verdict::agrees, Verdict::undecided,
                             Verdict::disagrees};
  return int(std::ranges::find(order, verdict) - order.begin());
}

}  // namespace

void decide(Assessment& found, const Claim& claim, const measure::Ladder& ladder,
            const JudgeContext& facts) {
  const auto& fit = found.displacement;
  found.verdict = compare(fit, claim, facts);
  if (is_more_than_claimed(found, claim, ladder, facts)) found.verdict = Verdict::agrees;
  // One history without a claim was not fitted for its order.
  const bool one_history =
      facts.finest && !claim.is_made() && ladder.size() == 1 && ladder.front().runs.size() == 1;
  if (!one_history) found.reason = fit.reason;
  const bool is_open = found.verdict == Verdict::undecided;
  // Of large errors finer levels show more.
  if (is_open && fit.on_envelope)
    found.reason =
        (fit.errors.back() > large_error ? Code("too-few-levels") : Code("more-samples")).name();
  if (is_open && claim.behaviour == Behaviour::stagnating && shows_a_line(fit) &&
      is_above_floor(fit, facts))
    found.reason = Code("contact-not-resolved").name();
  if (is_open && found.reason.empty() && shows_a_line(fit) && is_still_coarse(fit))
    found.reason = Code("too-few-levels").name();
  for (const auto& evidence : found.evidence) {
    if (evidence.code == "sparse-rows") found.reason = Code("sparse-rows").name();
    if (severity(evidence.verdict) <= severity(found.verdict)) continue;
    found.verdict = evidence.verdict;
    if (evidence.code == "tolerance-not-resolved")
      found.reason = Code("printed-digits").name();
    else if (evidence.code == "ends-early" || evidence.code == "wrong-limit")
      found.reason = evidence.code;
    else if (evidence.code != "impacts-miscounted")
      found.reason.clear();
  }
  if (claim.is_made() && severity(facts.least_verdict) > severity(found.verdict)) {
    found.verdict = facts.least_verdict;
    found.reason = facts.cause_against;
  }
  if (!facts.no_ladder.empty() && found.verdict == Verdict::not_claimed) {
    found.verdict = Verdict::undecided;
    found.reason = facts.no_ladder;
  }
  if (found.verdict == Verdict::disagrees) found.mismatch = mismatch_of(fit, claim, facts);
}

}  // namespace clackers::judge
