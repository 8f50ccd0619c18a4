#include "clackers/assess/convergence/judge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "clackers/assess/convergence/fit/error_ladder.hpp"
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

// The last run of the finest level; files come coarsest first.
const RunScore& finest_run(const Ladder& ladder) { return ladder.back().runs.back(); }

// The first run of the two finest levels that did not find the collisions it should.
std::optional<Evidence> miscounted(const Ladder& ladder, bool late_is_allowed) {
  for (auto level = ladder.end() - std::min<std::ptrdiff_t>(2, std::ssize(ladder));
       level != ladder.end(); ++level)
    for (const auto& run : level->runs) {
      if (!run.finished || !run.impacts) continue;
      const auto& found = *run.impacts;
      if (found.missed + found.extra == 0) continue;
      if (late_is_allowed && found.found == found.expected) continue;
      return Evidence{
          "collisions-miscounted",
          Verdict::disagrees,
          {run.step, double(found.matched), double(found.expected), double(found.extra)}};
    }
  return {};
}

// Whether printed digits are what stops the fit. It knows them as the rounding of its levels: it
// calls `exact` what lies below them throughout, and finds too few levels where they begin early.
bool stopped_by_printing(const LadderFit& fit, const RunScore& finest, const HistoryFacts& facts) {
  const double arithmetic = 1e-15 * double(facts.rows);
  const bool printed =
      facts.printed_floor > arithmetic && finest.u_error <= rounding_slack * facts.printed_floor;
  return printed && (fit.behaviour == Behaviour::exact || fit.behaviour == Behaviour::stagnating ||
                     fit.reason == "too-few-levels");
}

// The fit with the behaviour that the rules of judge.hpp give, first hit wins.
LadderFit behaviour_of(LadderFit fit, const Ladder& ladder, const Claim& claim,
                       const Facts& facts) {
  const bool no_line =
      !fit.has_line && fit.behaviour != Behaviour::exact && fit.reason != "contact-not-resolved";
  if (no_line && energy_left(ladder)) {
    fit.behaviour = Behaviour::divergent;
    fit.reason = Code("energy-growth").name();
  } else if (facts.finest && stopped_by_printing(fit, finest_run(ladder), *facts.finest)) {
    fit.behaviour = Behaviour::stagnating;
    fit.reason = Code("printed-digits").name();
    fit.floor = finest_run(ladder).u_error;
    fit.has_line = false;
  } else if (claim.behaviour == Behaviour::reduced && fit.behaviour == Behaviour::proper &&
             std::abs(fit.order - claim.order) <= order_tolerance * claim.order) {
    fit.behaviour = Behaviour::reduced;
  }
  return fit;
}

Verdict compare(const LadderFit& fit, const Claim& claim) {
  if (claim.behaviour == Behaviour::undecided) return Verdict::not_claimed;
  if (fit.behaviour == Behaviour::undecided) return Verdict::undecided;
  if (fit.reason == "printed-digits" && claim.behaviour != Behaviour::stagnating)
    return Verdict::undecided;
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
      return claim.reason.empty() || fit.reason == claim.reason ? Verdict::agrees
                                                                : Verdict::disagrees;
    default:
      return Verdict::agrees;
  }
}

Evidence tolerance_evidence(const RunScore& finest, double limit, double printed_floor) {
  const double error = finest.u_error;
  Evidence found{{}, Verdict::not_claimed, {error, limit, printed_floor}};
  if (!(std::abs(error - limit) > printed_floor)) {
    found.code = "tolerance-not-resolved";
    found.verdict = Verdict::undecided;
  } else {
    found.code = error <= limit ? "within-tolerance" : "beyond-tolerance";
    found.verdict = error <= limit ? Verdict::agrees : Verdict::disagrees;
  }
  return found;
}

// Why the history is of another motion than the case's.
std::optional<Evidence> other_motion(const RunScore& finest, const HistoryFacts& facts) {
  if (facts.first > 0.0 && facts.start_error > far_start)
    return Evidence{"other-start", Verdict::disagrees, {facts.start_error}};
  if (!finest.impacts || !facts.rows_resolve_collisions) return {};
  const auto& found = *finest.impacts;
  if (found.missed == 0 && found.extra == 0) return {};
  return Evidence{"other-collisions",
                  Verdict::disagrees,
                  {double(found.matched), double(found.expected), double(found.extra)}};
}

std::vector<Evidence> evidence_of(const LadderFit& fit, const Ladder& ladder, const Claim& claim,
                                  const Facts& facts) {
  std::vector<Evidence> all;
  const auto add = [&](std::optional<Evidence> found) {
    if (found) all.push_back(std::move(*found));
  };
  if (ladder.empty()) return all;
  const auto& finest = finest_run(ladder);
  const double printed = facts.finest ? facts.finest->printed_floor : 0.0;
  const bool claimed = claim.behaviour != Behaviour::undecided;
  if (fit.reason == "printed-digits")
    all.push_back({fit.reason, compare(fit, claim), {finest.u_error, printed}});
  // What is undecided stays so.
  if (claimed && compare(fit, claim) != Verdict::undecided)
    add(miscounted(ladder, claim.behaviour == Behaviour::stagnating));
  if (facts.tolerance) add(tolerance_evidence(finest, *facts.tolerance, printed));
  if (!facts.finest || claimed) return all;  // an expected divergence may lead to another motion
  if (!facts.tolerance && finest.impacts && !facts.finest->rows_resolve_collisions)
    all.push_back({"sparse-rows", Verdict::not_claimed, {}});
  add(other_motion(finest, *facts.finest));
  return all;
}

int severity(Verdict verdict) {
  constexpr std::array order{Verdict::not_claimed, Verdict::agrees, Verdict::undecided,
                             Verdict::disagrees};
  return int(std::ranges::find(order, verdict) - order.begin());
}

// Verdict and its reason: of the behaviour, overruled by what is more severe.
void decide(Assessment& found, const Claim& claim, const Ladder& ladder, bool is_history) {
  const auto& fit = found.displacement;
  found.verdict = compare(fit, claim);
  // One history without a claim was not fitted for its order.
  const bool one_history = is_history && claim.behaviour == Behaviour::undecided &&
                           ladder.size() == 1 && ladder.front().runs.size() == 1;
  if (!one_history) found.reason = fit.reason;
  for (const auto& evidence : found.evidence) {
    if (evidence.code == "sparse-rows") found.reason = Code("sparse-rows").name();
    if (severity(evidence.verdict) <= severity(found.verdict)) continue;
    found.verdict = evidence.verdict;
    if (evidence.code == "tolerance-not-resolved") found.reason = Code("printed-digits").name();
    if (evidence.code != "tolerance-not-resolved" && evidence.code != "collisions-miscounted")
      found.reason.clear();
  }
}

}  // namespace

Assessment judge(const Ladder& ladder, const Claim& claim, const Facts& facts) {
  Assessment found;
  FitContext context{.claimed_order = claim.order,
                     .contact_time = facts.contact_time,
                     .states_tolerance = claim.reason == "tolerance-floor"};
  const auto measured = fit(ladder, context, [](const RunScore& run) {
    return ErrorPoint{.error = run.u_error, .floor = run.rounding_floor};
  });
  found.velocity = fit(ladder, context, [](const RunScore& run) {
    return ErrorPoint{.error = run.v_error, .floor = run.rounding_floor};
  });
  context.saturation = std::numeric_limits<double>::infinity();
  found.impact_time = fit(ladder, context, impact_time_error);

  found.displacement = behaviour_of(measured, ladder, claim, facts);
  found.evidence = evidence_of(found.displacement, ladder, claim, facts);
  decide(found, claim, ladder, facts.finest.has_value());
  return found;
}

}  // namespace clackers::assess
