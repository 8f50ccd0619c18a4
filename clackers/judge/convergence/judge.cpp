#include "clackers/judge/convergence/judge.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "clackers/base/codes.hpp"
#include "clackers/base/constants.hpp"
#include "clackers/judge/convergence/claim_comparison.hpp"
#include "clackers/judge/convergence/fit/window.hpp"
#include "clackers/judge/convergence/judge_steps.hpp"

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

ErrorPoint velocity_error(const measure::RunScore& run) {
  return {.error = run.v_error, .floor = run.rounding_floor};
}

FitContext context_of(const Claim& claim, const JudgeContext& facts) {
  return {.claimed_order = claim.order,
          .order_tolerance =
              claim.behaviour == Behaviour::irregular ? envelope_order_tolerance : order_tolerance,
          .contact_time = facts.contact_time,
          .states_tolerance = claim.reason == "tolerance-floor",
          .by_tolerance = facts.by_tolerance,
          .wrong_limit = facts.wrong_limit,
          .noise = facts.noise};
}

// What the displacement errors of some levels are judged by.
struct Subject {
  const measure::Ladder& ladder;
  const Claim& claim;
  const JudgeContext& facts;
  FitContext context;

  bool agrees(const LadderFit& fit) const { return compare(fit, claim, facts) == Verdict::agrees; }

  // The fit of the levels from `first` on, in the place of that of all.
  LadderFit from_level(int first, const LadderFit& of_all) const {
    auto fine = fit({ladder.begin() + first, ladder.end()}, context, displacement_error);
    fine.first_level += first;
    fine.last_level += first;
    fine.steps = of_all.steps;
    fine.errors = of_all.errors;
    return fine;
  }
};

void deny(LadderFit& fit, std::string_view reason) {
  fit.behaviour = Behaviour::undecided;
  fit.has_line = false;
  fit.reason = reason;
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

void leave_out_other_impacts(const Subject& of, LadderFit& displacement) {
  // Impacts won and lost make errors as large as a floor.
  const bool is_of_impacts = shows_a_line(displacement) || (is_unexplained_floor(displacement) &&
                                                            displacement.floor > large_error);
  const int first = first_counted(of.ladder);
  if (first > displacement.first_level && is_of_impacts && !of.agrees(displacement))
    displacement = of.from_level(first, displacement);
}

// Steps that may take impacts in another order.
void leave_out_long_steps(const Subject& of, LadderFit& displacement) {
  const auto& [ladder, claim, facts, context] = of;
  if (!(facts.closest_impacts > 0.0) || facts.by_tolerance || !(claim.order > 0.0) ||
      !shows_a_line(displacement) || of.agrees(displacement))
    return;
  // Methods of irregular order are late by up to a step at each impact.
  const double longest =
      (claim.behaviour == Behaviour::irregular ? 1.0 / 32.0 : 2.0) * facts.closest_impacts;
  const auto resolved = std::ranges::find_if(
      ladder, [longest](double step) { return step <= longest; }, &measure::ScoreLevel::step);
  const int first = int(resolved - ladder.begin());
  if (std::ssize(ladder) - first < shortest_window) {
    deny(displacement, Code("too-few-levels").name());
    displacement.on_envelope = false;
  } else if (first > displacement.first_level) {
    displacement = of.from_level(first, displacement);
  }
}

// Coarse steps whose errors fall faster hide an envelope of lower order, and those whose errors are as
// large as impacts make them one of higher order, where the finer half shows it.
void take_finer_half(const Subject& of, LadderFit& displacement) {
  constexpr std::ptrdiff_t least_levels = 5;
  const auto levels = std::ssize(of.ladder), half = std::max(least_levels, levels / 2);
  if (of.claim.behaviour != Behaviour::irregular || !displacement.on_envelope || half >= levels ||
      of.agrees(displacement))
    return;
  auto fine = of.from_level(int(levels - half), displacement);
  const auto of_fine = compare(fine, of.claim, of.facts);
  const double whole = displacement.order;
  const bool is_lower = whole > of.claim.order, is_higher = fine.order - fine.spread > whole;
  if ((is_lower && of_fine != Verdict::disagrees) || (is_higher && of_fine == Verdict::agrees))
    displacement = std::move(fine);
}

// Of velocities only the order is claimed, that of a line or of an envelope.
Evidence velocity_evidence(const LadderFit& fit, const Claim& claim, const JudgeContext& facts) {
  const Claim line{shows_a_line(fit) ? fit.behaviour : Behaviour::proper, claim.velocity_order, {}};
  return evidence("velocity-order", compare(fit, line, facts),
                  {fit.order, fit.spread, claim.velocity_order});
}

}  // namespace

Assessment judge(const measure::Ladder& ladder, const Claim& claim, const JudgeContext& facts) {
  const Subject subject{ladder, claim, facts, context_of(claim, facts)};
  auto context = subject.context;
  Assessment found;
  found.displacement = behaviour_of(fit(ladder, context, displacement_error), ladder, claim, facts);
  if (claim.velocity_order > 0.0) context.claimed_order = claim.velocity_order;
  found.velocity = fit(ladder, context, velocity_error);
  context.claimed_order = claim.order;
  context.saturation = std::numeric_limits<double>::infinity();
  found.impact_time = fit(ladder, context, impact_time_error);

  leave_out_other_impacts(subject, found.displacement);
  leave_out_long_steps(subject, found.displacement);
  take_finer_half(subject, found.displacement);
  if (!facts.no_ladder.empty())
    for (auto* one : {&found.displacement, &found.velocity, &found.impact_time})
      deny(*one, facts.no_ladder);

  found.evidence =
      evidence_of(found, compare(found.displacement, claim, facts), ladder, claim, facts);
  if (claim.velocity_order > 0.0)
    found.evidence.push_back(velocity_evidence(found.velocity, claim, facts));
  decide(found, claim, ladder, facts);
  return found;
}

}  // namespace clackers::judge
