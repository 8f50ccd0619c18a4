#include <algorithm>
#include <cmath>

#include "clackers/base/codes.hpp"
#include "clackers/base/constants.hpp"
#include "clackers/judge/convergence/claim_comparison.hpp"
#include "clackers/judge/convergence/fit/error_ladder.hpp"
#include "clackers/judge/convergence/judge_steps.hpp"

namespace clackers::judge {
namespace {

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
bool is_growing_rounding(const LadderFit& fit, const measure::Ladder& ladder,
                         const JudgeContext& facts) {
  if (fit.reason != Code("error-growth").name() && fit.reason != Code("too-few-levels").name())
    return false;
  return std::ranges::all_of(ladder, [&](const measure::ScoreLevel& level) {
    return std::ranges::all_of(level.runs, [&](const measure::RunScore& run) {
      // A floor of printed digits is that of no steps.
      const double most = facts.finest ? double(facts.finest->rows) : infinity;
      const double steps = std::min(run.rounding_floor / epsilon, most);
      return run.finished &&
             run.u_error <= rounding_slack * std::max(run.rounding_floor, steps * steps * epsilon);
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

}  // namespace

bool is_unexplained_floor(const LadderFit& fit) {
  return fit.behaviour == Behaviour::stagnating &&
         (fit.reason == Code("unexplained-floor").name() ||
          fit.reason == Code("noise-floor").name());
}

LadderFit behaviour_of(LadderFit fit, const measure::Ladder& ladder, const Claim& claim,
                       const JudgeContext& facts) {
  const bool open = !shows_a_line(fit) && fit.behaviour != Behaviour::exact &&
                    fit.reason != Code("contact-not-resolved").name();
  const bool of_another_model = facts.contact_time > 0.0 && !claim.is_made() && has_far_limit(fit);
  // Where the energy is off by less than the largest one of the reference, a motion has not decayed as it should,
  // and has not grown.
  const auto too_much = [](const measure::RunScore& run) {
    return run.energy_ratio > largest_energy_ratio && !(run.energy_error < 1.0);
  };
  const auto too_little = [](const measure::RunScore& run) {
    return run.energy_ratio < least_energy_ratio;
  };
  if (claim.behaviour == Behaviour::exact && is_growing_rounding(fit, ladder, facts)) {
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

}  // namespace clackers::judge
