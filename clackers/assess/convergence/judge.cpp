#include "clackers/assess/convergence/judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/assess/convergence/ladder_fit.hpp"
#include "clackers/base/codes.hpp"

namespace clackers::assess {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

template <class Measure>
LadderFit fit(const Ladder& ladder, const FitContext& context, const Measure& measure) {
  std::vector<ErrorLevel> errors;
  for (const auto& level : ladder) {
    errors.emplace_back();
    for (const auto& run : level.runs) {
      ErrorPoint point = measure(run);
      point.step = run.step;
      if (!run.finished) point.error = unknown;
      errors.back().push_back(point);
    }
  }
  return fit_ladder(errors, context);
}

ErrorPoint impact_time_error(const RunScore& run) {
  if (!run.impacts || run.impacts->matched == 0) return {.error = unknown};
  return {.error = run.impacts->worst_time_error, .floor = run.impacts->rounding_floor};
}

// Whether most finished runs of both finest levels end with too much or too little energy.
bool energy_left(const Ladder& ladder) {
  if (ladder.size() < 2) return false;
  return std::all_of(ladder.end() - 2, ladder.end(), [](const Level& level) {
    const auto wrong = [](const RunScore& run) {
      return run.finished &&
             (run.energy_ratio < least_energy_ratio || run.energy_ratio > largest_energy_ratio);
    };
    return 2 * std::ranges::count_if(level.runs, wrong) > std::ssize(level.runs);
  });
}

// Whether a run of the two finest levels missed a collision or found one too many.
bool miscounted(const Ladder& ladder, bool late_is_allowed) {
  for (auto level = ladder.end() - std::min<std::ptrdiff_t>(2, std::ssize(ladder));
       level != ladder.end(); ++level)
    for (const auto& run : level->runs) {
      if (!run.finished || !run.impacts) continue;
      const auto& found = *run.impacts;
      if (found.missed + found.extra == 0) continue;
      if (late_is_allowed && found.found == found.expected) continue;
      return true;
    }
  return false;
}

// Relabels a line of the very slope that is claimed as reduced.
void name_as_claimed(LadderFit& fit, const Claim& claim) {
  if (claim.behaviour == Behaviour::reduced && fit.behaviour == Behaviour::proper &&
      std::abs(fit.order - claim.order) <= order_tolerance * claim.order)
    fit.behaviour = Behaviour::reduced;
}

Verdict compare(const LadderFit& fit, const Claim& claim) {
  if (fit.behaviour == Behaviour::undecided) return Verdict::undecided;
  if (fit.behaviour != claim.behaviour)
    return fit.behaviour == Behaviour::exact ? Verdict::undecided : Verdict::disagrees;
  const double off = std::abs(fit.order - claim.order);
  switch (claim.behaviour) {
    case Behaviour::proper:
    case Behaviour::reduced:
      return off <= order_tolerance * claim.order ? Verdict::agrees : Verdict::disagrees;
    case Behaviour::irregular:
      if (off > fit.spread && off > envelope_order_tolerance * claim.order)
        return Verdict::disagrees;
      return off > envelope_order_tolerance * claim.order ||
                     fit.spread > envelope_spread * claim.order
                 ? Verdict::undecided
                 : Verdict::agrees;
    case Behaviour::stagnating:
      return fit.reason == claim.reason ? Verdict::agrees : Verdict::disagrees;
    default:
      return Verdict::agrees;
  }
}

}  // namespace

Assessment judge(const Ladder& ladder, const Claim& claim, double contact_time) {
  Assessment found;
  FitContext context{.claimed_order = claim.order,
                     .contact_time = contact_time,
                     .states_tolerance = claim.reason == "tolerance-floor"};
  found.displacement = fit(ladder, context, [](const RunScore& run) {
    return ErrorPoint{.error = run.u_error, .floor = run.rounding_floor};
  });
  found.velocity = fit(ladder, context, [](const RunScore& run) {
    return ErrorPoint{.error = run.v_error, .floor = run.rounding_floor};
  });
  context.saturation = std::numeric_limits<double>::infinity();
  found.impact_time = fit(ladder, context, impact_time_error);

  auto& shown = found.displacement;
  name_as_claimed(shown, claim);
  const bool no_line = !shown.has_line && shown.behaviour != Behaviour::exact &&
                       shown.reason != "contact-not-resolved";
  if (no_line && energy_left(ladder)) {
    shown.behaviour = Behaviour::divergent;
    shown.reason = Code("energy-growth").name();
  }
  if (claim.behaviour == Behaviour::undecided) {
    found.verdict = Verdict::not_claimed;
  } else {
    found.verdict = compare(shown, claim);
    if (found.verdict != Verdict::undecided &&
        miscounted(ladder, claim.behaviour == Behaviour::stagnating))
      found.verdict = Verdict::disagrees;
  }
  return found;
}

}  // namespace clackers::assess
