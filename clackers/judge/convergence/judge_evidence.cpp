#include "clackers/judge/convergence/judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "clackers/base/codes.hpp"
#include "clackers/judge/convergence/ladder_fit.hpp"

namespace clackers::judge {
namespace {

// Smaller shares are not reported.
constexpr double least_reported_share = 1.0 / 16.0;

Evidence miscount(const measure::RunScore& run) {
  const auto& found = *run.impacts;
  return evidence("impacts-miscounted", Verdict::disagrees,
                  {run.step, double(found.matched), double(found.expected), double(found.extra)});
}

// The first run of the two finest levels that did not find the impacts it should. Where the errors
// decide nothing, steps may be too long to find them: then only if every run of both levels misses as
// many and has as many too many, as no refinement will mend. Where errors may scatter as claimed, gentle
// impacts are off by more than their match may be at some steps: then only if most runs miscount.
// A claimed floor may make impacts late; the very one that is claimed, where it is large, half as
// many more or fewer. A claim to diverge says nothing of impacts, nor does a method without a law of them.
std::optional<Evidence> miscounted(const measure::Ladder& ladder, const LadderFit& fit,
                                   const Claim& claim, Verdict of_behaviour) {
  if (claim.behaviour == Behaviour::divergent || claim.reason == Code("no-impact-law").name())
    return {};
  const auto is_of_floor = [&](const measure::ImpactScore& impacts) {
    const auto more = std::abs(impacts.found - impacts.expected);
    return claim.behaviour == Behaviour::stagnating &&
           (more == 0 || (fit.reason == claim.reason && fit.floor > large_error &&
                          2 * more <= impacts.expected));
  };
  const measure::RunScore* first = nullptr;
  bool all_alike = true;
  int miscounting = 0, finished = 0;
  for (auto level = ladder.end() - std::min<std::ptrdiff_t>(2, std::ssize(ladder));
       level != ladder.end(); ++level)
    for (const auto& run : level->runs) {
      if (!run.finished) continue;
      ++finished;
      if (!miscounts(run) || is_of_floor(*run.impacts)) {
        all_alike = false;
        continue;
      }
      ++miscounting;
      if (first == nullptr) first = &run;
      all_alike = all_alike && run.impacts->missed == first->impacts->missed &&
                  run.impacts->extra == first->impacts->extra;
    }
  // Another outcome of simultaneous impacts has other impacts after it.
  if (first == nullptr || fit.reason == Code("simultaneous-impacts").name()) return {};
  const bool may_scatter = claim.behaviour == Behaviour::irregular && fit.has_line;
  if (may_scatter && 2 * miscounting <= finished) return {};
  const bool open = of_behaviour == Verdict::undecided ||
                    (fit.has_line && fit.order < lowest_real_order) ||
                    (may_scatter && fit.errors.back() > large_error);
  if (open && (!all_alike || fit.reason == Code("contact-not-resolved").name())) return {};
  return miscount(*first);
}

Evidence tolerance_evidence(const measure::RunScore& finest, double limit, double printed_floor) {
  const double error = finest.u_error;
  const std::vector<double> numbers{error, limit, printed_floor};
  if (!(std::abs(error - limit) > printed_floor))
    return evidence("tolerance-not-resolved", Verdict::undecided, numbers);
  if (error <= limit) return evidence("within-tolerance", Verdict::agrees, numbers);
  return evidence("beyond-tolerance", Verdict::disagrees, numbers);
}

// Why the history is of another motion than the case's.
std::optional<Evidence> other_motion(const measure::RunScore& finest, const HistoryFacts& facts) {
  if (facts.first > 0.0 && facts.start_error > far_start)
    return evidence("other-start", Verdict::disagrees, {facts.start_error});
  if (!facts.rows_resolve_impacts || !miscounts(finest)) return {};
  const auto& found = *finest.impacts;
  return evidence("other-impacts", Verdict::disagrees,
                  {double(found.matched), double(found.expected), double(found.extra)});
}

std::optional<Evidence> ends_early(const HistoryFacts& facts) {
  const bool before_impacts = facts.expected > 0 && facts.expected_to_last == 0;
  if (facts.last >= early_end * facts.end && !before_impacts) return {};
  return evidence("ends-early", Verdict::undecided,
                  {facts.last, facts.end, double(facts.expected_to_last), double(facts.expected)});
}

std::optional<Evidence> velocity_order(const Assessment& fits) {
  const auto &u = fits.displacement, &v = fits.velocity;
  if (!u.has_line || !v.has_line) return {};
  const double lower = u.order - v.order;
  if (!(lower > lower_velocity_order && lower > u.spread + v.spread)) return {};
  return evidence("velocity-order-lower", Verdict::not_claimed, {v.order, u.order});
}

std::optional<Evidence> error_over_tolerance(const measure::Ladder& ladder, const LadderFit& fit) {
  if (!fit.has_line) return {};
  double sum = 0.0, least = std::numeric_limits<double>::infinity(), most = 0.0;
  int runs = 0;
  for (const auto& level : ladder)
    for (const auto& run : level.runs) {
      if (!run.finished || !(run.u_error > 0.0) || run.step > fit.largest_step ||
          run.step < fit.smallest_step)
        continue;
      const double factor = run.u_error / run.step;
      sum += std::log(factor);
      least = std::min(least, factor);
      most = std::max(most, factor);
      ++runs;
    }
  return evidence("error-over-tolerance", Verdict::not_claimed,
                  {std::exp(sum / runs), least, most});
}

bool claims_convergence(const Claim& claim) {
  return claim.behaviour == Behaviour::exact || claim.behaviour == Behaviour::proper ||
         claim.behaviour == Behaviour::reduced || claim.behaviour == Behaviour::irregular;
}

// What the fit itself noticed.
std::vector<Evidence> of_the_fit(const LadderFit& fit, const measure::Ladder& ladder,
                                 const Claim& claim, const JudgeContext& facts) {
  std::vector<Evidence> all;
  const auto note = [&](EvidenceCode code, std::vector<double> numbers) {
    all.push_back(evidence(code, Verdict::not_claimed, std::move(numbers)));
  };
  if (fit.coincident_share >= least_reported_share)
    note("commensurate-steps", {fit.coincident_share});
  if (fit.cancel_step > 0.0) note("errors-cancel", {fit.cancel_step});
  const bool shared = fit.reason == Code("simultaneous-impacts").name() && facts.shared;
  // Errors as large as the motion grow and fall by chance.
  if (fit.stable_step > 0.0 && !shared) note("unstable-coarse-steps", {fit.stable_step});
  if (shared)
    note("simultaneous-impacts", {facts.shared->instant.t, double(facts.shared->instant.contacts),
                                  facts.shared->error_before, facts.shared->error_after});
  const bool unresolved = fit.reason == Code("contact-not-resolved").name();
  if (facts.contact_time > 0.0 && !facts.by_tolerance &&
      (unresolved || fit.behaviour == Behaviour::stagnating))
    note("steps-per-contact", {facts.contact_time / finest_run(ladder).step, facts.contact_time});
  const double order = claim.behaviour == Behaviour::irregular ? claim.order : fit.order;
  if (fit.on_envelope && fit.spread > envelope_order_tolerance * order)
    note("more-samples", {fit.order, fit.spread});
  return all;
}

}  // namespace

bool miscounts(const measure::RunScore& run) {
  return run.finished && run.impacts && run.impacts->missed + run.impacts->extra > 0;
}

const measure::RunScore& finest_run(const measure::Ladder& ladder) {
  return ladder.back().runs.back();
}

std::vector<Evidence> evidence_of(const Assessment& fits, Verdict of_behaviour,
                                  const measure::Ladder& ladder, const Claim& claim,
                                  const JudgeContext& facts) {
  std::vector<Evidence> all;
  if (ladder.empty() || ladder.back().runs.empty()) return all;
  const auto add = [&](std::optional<Evidence> found) {
    if (found) all.push_back(std::move(*found));
  };
  const auto& fit = fits.displacement;
  const auto& finest = finest_run(ladder);
  const double printed = facts.finest ? facts.finest->printed_floor : 0.0;
  const bool claimed = claim.is_made();
  if (fit.reason == Code("printed-digits").name())
    all.push_back(evidence("printed-digits", of_behaviour, {finest.u_error, printed}));
  if (claimed) add(miscounted(ladder, fit, claim, of_behaviour));
  // Whatever the order, it is that of another motion.
  const auto wrong_limit = evidence("wrong-limit", Verdict::disagrees);
  if (facts.wrong_limit && claims_convergence(claim)) all.push_back(wrong_limit);
  if (facts.tolerance) add(tolerance_evidence(finest, *facts.tolerance, printed));
  for (auto& found : of_the_fit(fit, ladder, claim, facts)) all.push_back(std::move(found));
  if (!(claim.velocity_order > 0.0)) add(velocity_order(fits));
  if (facts.by_tolerance) add(error_over_tolerance(ladder, fit));
  if (!facts.finest) return all;
  add(ends_early(*facts.finest));
  // An expected divergence may lead to another motion; a tolerance that is met is met.
  if (claimed || facts.tolerance) return all;
  if (finest.impacts && !facts.finest->rows_resolve_impacts)
    all.push_back(evidence("sparse-rows", Verdict::not_claimed, {}));
  add(other_motion(finest, *facts.finest));
  if (facts.wrong_limit) all.push_back(wrong_limit);
  return all;
}

}  // namespace clackers::judge
