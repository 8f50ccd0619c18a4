#include "clackers/judge/convergence/claim_comparison.hpp"

#include <cmath>

#include "clackers/base/codes.hpp"
#include "clackers/judge/convergence/fit/error_ladder.hpp"

namespace clackers::judge {
namespace {

// An error, over the largest envelope, as large as the motion.
constexpr double of_the_motion = 0.1;

// Of a line or an envelope whose order is off by more than allowed, and of one that is not.
Verdict compare_order(const LadderFit& fit, double claimed, double tolerance) {
  const double off = std::abs(fit.order - claimed);
  // An envelope contradicts where its whole interval lies outside what is allowed.
  const double reach = fit.on_envelope ? fit.spread + tolerance * claimed : fit.spread;
  if (off > tolerance * claimed) return off > reach ? Verdict::disagrees : Verdict::undecided;
  const bool few = fit.last_level - fit.first_level + 1 < enough_octaves;
  const bool of_envelope = fit.on_envelope || tolerance == envelope_order_tolerance;
  const double most = !of_envelope ? line_spread : few ? envelope_spread : wide_envelope_spread;
  return fit.spread > most * claimed ? Verdict::undecided : Verdict::agrees;
}

// Whether errors that fell along a line stop far above rounding, and nothing says why.
bool ends_in_large_floor(const LadderFit& fit, const JudgeContext& facts) {
  const bool is_unexplained =
      fit.reason == Code("noise-floor").name() || fit.reason == Code("unexplained-floor").name();
  return shows_a_line(fit) && fit.floor_step > 0.0 && fit.floor > large_error && is_unexplained &&
         !facts.noise;
}

Verdict compare_floor(const LadderFit& fit, const Claim& claim, const JudgeContext& facts) {
  const bool has_floor =
      fit.behaviour == Behaviour::stagnating ||
      (fit.floor_step > 0.0 && fit.reason == claim.reason && !claim.reason.empty());
  // As large as the motion, and of no stiffness.
  if (fit.reason == Code("simultaneous-impacts").name() && claim.reason.empty())
    return Verdict::agrees;
  // Errors that fall have no floor; of no order that a method has, they bend towards one or still come
  // from their coarse range.
  if (!has_floor)
    return shows_a_line(fit) && (fit.order < lowest_real_order || is_above_floor(fit, facts))
               ? Verdict::undecided
               : Verdict::disagrees;
  return claim.reason.empty() || fit.reason == claim.reason ? Verdict::agrees : Verdict::disagrees;
}

}  // namespace

bool shows_a_line(const LadderFit& fit) {
  return fit.behaviour == Behaviour::proper || fit.behaviour == Behaviour::reduced ||
         fit.behaviour == Behaviour::irregular;
}

bool is_above_floor(const LadderFit& fit, const JudgeContext& facts) {
  constexpr double enough_steps = 128.0;
  return facts.contact_time > 0.0 && facts.contact_time < enough_steps * fit.smallest_step;
}

bool is_still_coarse(const LadderFit& fit) {
  constexpr double least_rise = 0.05;
  const auto rate = [&](int i) {
    const auto at = std::size_t(i);
    return std::log(fit.errors[at] / fit.errors[at + 1]) /
           std::log(fit.steps[at] / fit.steps[at + 1]);
  };
  const int last = fit.last_level - 1;
  return fit.first_level < last && std::size_t(fit.last_level) < fit.errors.size() &&
         fit.errors.back() > of_the_motion && rate(last) > rate(fit.first_level) + least_rise;
}

Verdict compare(const LadderFit& fit, const Claim& claim, const JudgeContext& facts) {
  if (claim.behaviour == Behaviour::undecided) return Verdict::not_claimed;
  if (fit.behaviour == Behaviour::undecided) return Verdict::undecided;
  if (claim.behaviour == Behaviour::stagnating && fit.behaviour != Behaviour::exact)
    return compare_floor(fit, claim, facts);
  if (fit.reason == Code("printed-digits").name() && !fit.has_line) return Verdict::undecided;
  if (fit.behaviour == Behaviour::exact)
    return claim.behaviour == Behaviour::exact ? Verdict::agrees : Verdict::undecided;
  const bool order_claimed = claim.order > 0.0 && claim.behaviour != Behaviour::divergent;
  if (order_claimed && ends_in_large_floor(fit, facts)) return Verdict::undecided;
  const bool line = fit.behaviour == Behaviour::proper || fit.behaviour == Behaviour::reduced;
  const bool line_claimed =
      claim.behaviour == Behaviour::proper || claim.behaviour == Behaviour::reduced;
  if (claim.behaviour == Behaviour::irregular && (line || fit.behaviour == Behaviour::irregular))
    return compare_order(fit, claim.order, envelope_order_tolerance);
  if (line && line_claimed) {
    const double tolerance = facts.by_tolerance ? tolerance_proportional : order_tolerance;
    const auto found = compare_order(fit, claim.order, tolerance);
    if (found == Verdict::disagrees && fit.order < claim.order && is_still_coarse(fit))
      return Verdict::undecided;
    // Reduced claims less than proper; both are told by the order alone.
    return found == Verdict::agrees && fit.behaviour != claim.behaviour && !facts.by_tolerance
               ? Verdict::disagrees
               : found;
  }
  // Errors of the size of the motion that neither grow nor fall are as far from it.
  if (claim.behaviour == Behaviour::divergent && fit.behaviour == Behaviour::stagnating &&
      fit.floor > of_the_motion)
    return Verdict::agrees;
  return fit.behaviour == claim.behaviour ? Verdict::agrees : Verdict::disagrees;
}

Mismatch mismatch_of(const LadderFit& fit, const Claim& claim, const JudgeContext& facts) {
  if (compare(fit, claim, facts) != Verdict::disagrees) return Mismatch::evidence;
  const bool order_claimed = claim.order > 0.0;
  const bool alike = fit.behaviour == claim.behaviour ||
                     (fit.behaviour == Behaviour::reduced && claim.behaviour == Behaviour::proper);
  if (claim.behaviour == Behaviour::stagnating && fit.behaviour == Behaviour::stagnating)
    return Mismatch::floor_reason;
  if (!alike || !order_claimed) return Mismatch::behaviour;
  return fit.order < claim.order ? Mismatch::lower_order : Mismatch::higher_order;
}

}  // namespace clackers::judge
