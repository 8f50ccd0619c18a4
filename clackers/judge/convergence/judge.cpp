#include "clackers/judge/convergence/judge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "clackers/base/codes.hpp"
#include "clackers/base/constants.hpp"
#include "clackers/judge/convergence/claim_comparison.hpp"
#include "clackers/judge/convergence/fit/error_ladder.hpp"
#include "clackers/judge/convergence/fit/window.hpp"
#include "clackers/judge/convergence/ladder_fit.hpp"

namespace clackers::judge {
namespace {

LadderFit fit(const measure::Ladder& ladder, const FitContext& context, const auto& measure) {
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

ErrorPoint displacement_error(const measure::RunScore& run) {
  return {.error = run.u_error, .floor = run.rounding_floor};
}

ErrorPoint impact_time_error(const measure::RunScore& run) {
  if (!run.impacts || run.impacts->matched == 0) return {.error = unknown};
  return {.error = run.impacts->worst_time_error, .floor = run.impacts->rounding_floor};
}

// Whether the energy at the end is wrong, as asked, in most runs of both finest levels.
bool energy_is(const measure::Ladder& ladder, auto wrong) {
  if (ladder.size() < 2) return false;
  return std::all_of(ladder.end() - 2, ladder.end(), [&](const measure::ScoreLevel& level) {
    const auto run_is = [&](const measure::RunScore& run) { return run.finished && wrong(run); };
    return 2 * std::ranges::count_if(level.runs, run_is) > std::ssize(level.runs);
  });
}

// Whether the largest error of the finest level is smaller than that of the level before it by more
// than a floor would let it.
bool errors_fall(const LadderFit& fit) {
  constexpr double least_fall = 0.95;
  const auto n = fit.errors.size();
  return n >= 2 && fit.errors[n - 1] < least_fall * fit.errors[n - 2];
}

// Whether the errors of the finest levels are as large as the motion and do not fall.
bool stays_large(const LadderFit& fit) {
  constexpr std::ptrdiff_t levels = 4;
  constexpr double large = 0.5, least_fall = 0.5;
  if (std::ssize(fit.errors) < levels) return false;
  const auto [least, most] = std::minmax_element(fit.errors.end() - levels, fit.errors.end());
  return *least >= large && fit.errors.back() >= least_fall * *most;
}

// Whether they are the same on the four finest levels: the runs have a limit.
bool has_far_limit(const LadderFit& fit) {
  if (!stays_large(fit)) return false;
  constexpr double flat = 1.05;
  const auto [least, most] = std::minmax_element(fit.errors.end() - 4, fit.errors.end());
  return *most < flat * *least;
}

// Whether printed digits are what stops the fit. It knows them as the rounding of its levels: it
// calls `exact` what lies below them throughout, and finds too few levels where they begin early.
bool stopped_by_printing(const LadderFit& fit, const measure::RunScore& finest,
                         const HistoryFacts& facts) {
  const double arithmetic = 1e-15 * double(facts.rows);
  const bool printed =
      facts.printed_floor > arithmetic && finest.u_error <= rounding_slack * facts.printed_floor;
  return printed &&
         (fit.behaviour == Behaviour::exact || fit.behaviour == Behaviour::stagnating ||
          fit.reason == Code("too-few-levels").name() || fit.reason == Code("noise-floor").name());
}

// Whether errors that grow as steps shrink are rounding: of a method that divides differences of displacements
// by h squared, the square of the number of steps times 2^-52.
bool is_growing_rounding(const LadderFit& fit, const measure::Ladder& ladder) {
  if (fit.reason != Code("error-growth").name() && fit.reason != Code("too-few-levels").name())
    return false;
  return std::ranges::all_of(ladder, [](const measure::ScoreLevel& level) {
    return std::ranges::all_of(level.runs, [](const measure::RunScore& run) {
      const double steps = run.rounding_floor / 0x1p-52;
      return run.finished && run.u_error <= rounding_slack * steps * run.rounding_floor;
    });
  });
}

// Whether errors not far below the motion fall by no order that a method has, while most runs of the finest
// level still miss impacts or have some too many.
bool is_of_other_impacts(const LadderFit& fit, const measure::Ladder& ladder) {
  if (!shows_a_line(fit) || fit.order >= lowest_real_order || fit.errors.back() <= large_error)
    return false;
  const auto& runs = ladder.back().runs;
  return 2 * std::ranges::count_if(runs, miscounts) > std::ssize(runs);
}

bool is_unexplained_floor(const LadderFit& fit) {
  return fit.behaviour == Behaviour::stagnating &&
         (fit.reason == Code("unexplained-floor").name() ||
          fit.reason == Code("noise-floor").name());
}

// The fit with the behaviour that the rules of judge.hpp give, first hit wins.
LadderFit behaviour_of(LadderFit fit, const measure::Ladder& ladder, const Claim& claim,
                       const JudgeContext& facts) {
  const bool open = !shows_a_line(fit) && fit.behaviour != Behaviour::exact &&
                    fit.reason != Code("contact-not-resolved").name();
  const bool of_another_model = facts.contact_time > 0.0 && !claim.is_made() && has_far_limit(fit);
  // Less than all of the initial energy too much: a motion that should have decayed, and has not grown.
  const auto too_much = [](const measure::RunScore& run) {
    return run.energy_ratio > largest_energy_ratio && !(run.energy_error < 1.0);
  };
  const auto too_little = [](const measure::RunScore& run) {
    return run.energy_ratio < least_energy_ratio;
  };
  if (claim.behaviour == Behaviour::exact && is_growing_rounding(fit, ladder)) {
    fit.behaviour = Behaviour::exact;
    fit.reason.clear();
  } else if (open && !facts.wrong_limit && !of_another_model && !errors_fall(fit) &&
             energy_is(ladder, too_much)) {
    fit.behaviour = Behaviour::divergent;
    fit.reason = Code("energy-growth").name();
  } else if (open && facts.shared && comes_from_shared_impacts(*facts.shared) &&
             (is_unexplained_floor(fit) || stays_large(fit))) {
    if (fit.behaviour == Behaviour::undecided) fit.behaviour = Behaviour::divergent;
    fit.reason = Code("simultaneous-impacts").name();
  } else if (open && of_another_model) {
    fit.behaviour = Behaviour::stagnating;
    fit.reason = Code("contact-stiffness").name();
    fit.floor = fit.errors.back();
  } else if (is_unexplained_floor(fit) && fit.floor > large_error && explains_no_order(claim)) {
    fit.reason = claim.reason;
  } else if (fit.behaviour == Behaviour::undecided && open && errors_fall(fit) &&
             energy_is(ladder, too_little)) {
    fit.reason = Code("numerical-damping").name();
  } else if (is_of_other_impacts(fit, ladder)) {
    fit.behaviour = Behaviour::undecided;
    fit.has_line = fit.on_envelope = false;
    fit.reason = Code("too-few-levels").name();
  } else if (facts.finest && stopped_by_printing(fit, finest_run(ladder), *facts.finest)) {
    if (!fit.has_line) {
      fit.behaviour = Behaviour::stagnating;
      fit.floor = finest_run(ladder).u_error;
    }
    fit.reason = Code("printed-digits").name();
  }
  const bool is_of_claimed_order =
      std::abs(fit.order - claim.order) <= order_tolerance * claim.order;
  if (is_of_claimed_order &&
      ((claim.behaviour == Behaviour::reduced && fit.behaviour == Behaviour::proper) ||
       (claim.behaviour == Behaviour::proper && fit.behaviour == Behaviour::irregular &&
        fit.scatter < std::max(proper_scatter, std::exp2(proper_octaves * claim.order)))))
    fit.behaviour = claim.behaviour;
  return fit;
}

// The first level behind all those at which more than a quarter of the runs miss impacts or have some too
// many while errors are not far below the motion; 0 where the finest one is such a level.
int first_counted(const measure::Ladder& ladder) {
  const auto is_of_other_impacts = [](const measure::ScoreLevel& level) {
    return 4 * std::ranges::count_if(level.runs,
                                     [](const measure::RunScore& run) {
                                       return miscounts(run) && run.u_error > large_error;
                                     }) >
           std::ssize(level.runs);
  };
  const auto last = std::find_if(ladder.rbegin(), ladder.rend(), is_of_other_impacts);
  return last == ladder.rbegin() ? 0 : int(ladder.rend() - last);
}

// The fit of the levels from `first` on, in the place of that of all.
LadderFit from_level(const measure::Ladder& ladder, int first, const FitContext& context,
                     const LadderFit& of_all) {
  auto fine = fit({ladder.begin() + first, ladder.end()}, context, displacement_error);
  fine.first_level += first;
  fine.last_level += first;
  fine.steps = of_all.steps;
  fine.errors = of_all.errors;
  return fine;
}

// Of velocities only the order is claimed, that of a line or of an envelope.
Evidence velocity_evidence(const LadderFit& fit, const Claim& claim, const JudgeContext& facts) {
  const Claim line{shows_a_line(fit) ? fit.behaviour : Behaviour::proper, claim.velocity_order, {}};
  return evidence("velocity-order", compare(fit, line, facts),
                  {fit.order, fit.spread, claim.velocity_order});
}

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

// Verdict and its reason: of the behaviour, overruled by what is more severe.
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

}  // namespace

Assessment judge(const measure::Ladder& ladder, const Claim& claim, const JudgeContext& facts) {
  Assessment found;
  FitContext context{.claimed_order = claim.order,
                     .order_tolerance = claim.behaviour == Behaviour::irregular
                                            ? envelope_order_tolerance
                                            : order_tolerance,
                     .contact_time = facts.contact_time,
                     .states_tolerance = claim.reason == "tolerance-floor",
                     .by_tolerance = facts.by_tolerance,
                     .wrong_limit = facts.wrong_limit,
                     .noise = facts.noise};
  const auto of_displacement = context;
  found.displacement = behaviour_of(fit(ladder, context, displacement_error), ladder, claim, facts);
  if (claim.velocity_order > 0.0) context.claimed_order = claim.velocity_order;
  found.velocity = fit(ladder, context, [](const measure::RunScore& run) {
    return ErrorPoint{.error = run.v_error, .floor = run.rounding_floor};
  });
  context.claimed_order = claim.order;
  context.saturation = std::numeric_limits<double>::infinity();
  found.impact_time = fit(ladder, context, impact_time_error);

  // Impacts won and lost make errors as large as a floor.
  const bool is_of_impacts =
      shows_a_line(found.displacement) ||
      (is_unexplained_floor(found.displacement) && found.displacement.floor > large_error);
  if (const int first = first_counted(ladder);
      first > found.displacement.first_level && is_of_impacts &&
      compare(found.displacement, claim, facts) != Verdict::agrees)
    found.displacement = from_level(ladder, first, of_displacement, found.displacement);
  if (facts.closest_impacts > 0.0 && !facts.by_tolerance && claim.order > 0.0 &&
      shows_a_line(found.displacement) &&
      compare(found.displacement, claim, facts) != Verdict::agrees) {
    // Methods of irregular order are late by up to a step at each impact.
    const double longest =
        (claim.behaviour == Behaviour::irregular ? 1.0 / 32.0 : 2.0) * facts.closest_impacts;
    const auto is_resolved = [&](const measure::ScoreLevel& level) {
      return level.step <= longest;
    };
    const int first = int(std::ranges::find_if(ladder, is_resolved) - ladder.begin());
    if (std::ssize(ladder) - first < shortest_window) {
      found.displacement.behaviour = Behaviour::undecided;
      found.displacement.has_line = found.displacement.on_envelope = false;
      found.displacement.reason = Code("too-few-levels").name();
    } else if (first > found.displacement.first_level) {
      found.displacement = from_level(ladder, first, of_displacement, found.displacement);
    }
  }
  // Coarse steps whose errors fall faster hide an envelope of lower order, and those whose errors are as
  // large as impacts make them one of higher order, where the finer half shows it.
  constexpr std::ptrdiff_t least_levels = 5;
  const auto half = std::max(least_levels, std::ssize(ladder) / 2);
  const auto of_all = compare(found.displacement, claim, facts);
  if (claim.behaviour == Behaviour::irregular && found.displacement.on_envelope &&
      half < std::ssize(ladder) && of_all != Verdict::agrees) {
    auto fine =
        from_level(ladder, int(std::ssize(ladder) - half), of_displacement, found.displacement);
    const auto of_fine = compare(fine, claim, facts);
    const double whole = found.displacement.order;
    const bool is_lower = whole > claim.order;
    const bool is_higher = fine.order - fine.spread > whole;
    if ((is_lower && of_fine != Verdict::disagrees) || (is_higher && of_fine == Verdict::agrees))
      found.displacement = std::move(fine);
  }
  if (!facts.no_ladder.empty())
    for (auto* one : {&found.displacement, &found.velocity, &found.impact_time}) {
      one->behaviour = Behaviour::undecided;
      one->has_line = false;
      one->reason = facts.no_ladder;
    }
  found.evidence =
      evidence_of(found, compare(found.displacement, claim, facts), ladder, claim, facts);
  if (claim.velocity_order > 0.0)
    found.evidence.push_back(velocity_evidence(found.velocity, claim, facts));
  decide(found, claim, ladder, facts);
  return found;
}

}  // namespace clackers::judge
