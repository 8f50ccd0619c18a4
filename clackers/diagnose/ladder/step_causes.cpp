#include <algorithm>
#include <cmath>

#include "clackers/diagnose/ladder/impact_location.hpp"
#include "clackers/diagnose/ladder/ladder_families.hpp"
#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::diagnose {
namespace {

constexpr long long most_step_impacts = 50;

// Largest distance of t / h from a whole number over the first impacts.
double off_grid(const model::Motion& motion, double step) {
  const auto known = std::min(most_step_impacts, motion.impact_count(motion.end()));
  double largest = 0.0;
  for (long long k = 1; k <= known; ++k) {
    const double steps = motion.impact(k).t / step;
    largest = std::max(largest, std::abs(steps - std::round(steps)));
  }
  return largest;
}

std::vector<const measure::RunScore*> runs_of(const measure::Ladder& ladder) {
  std::vector<const measure::RunScore*> runs;
  for (const auto& level : ladder)
    for (const auto& run : level.runs) runs.push_back(&run);
  return runs;
}

// Whether impacts are located within their steps: those of histories that fall off the grid by the
// method's own error are late by next to none of that.
bool are_located(const DiagnosisInput& question) {
  constexpr double small_part = 0.1;
  int on_row = 0, all = 0;
  for (const auto& seen : question.histories)
    for (const auto& impact : locate_impacts(seen, question.problem).impacts) {
      const double steps = impact.t / seen.facts.step;
      on_row += !(std::abs(impact.delay_steps) < small_part * std::abs(steps - std::round(steps)));
      ++all;
    }
  return all > 0 && 10 * on_row < all;
}

// Runs whose steps divide the times of impacts, where that makes their errors smaller than those of
// their neighbours, or where there are no other runs to compare with. Where impacts act at steps
// their errors are by rounding 0 or those of a whole step.
void commensurate(const DiagnosisInput& question, bool impacts_at_steps,
                  std::vector<Diagnosis>& found) {
  const auto known = question.motion.impact_count(question.motion.end());
  if (known == 0 || question.by_tolerance) return;
  // Of random steps 2 % come as near with one impact, 0.04 % with two at unrelated times.
  const double near = known == 1 ? 1e-3 : 1e-2;
  // Steps are known to more digits than this.
  constexpr double divides = 1e-4;
  std::vector<const measure::RunScore*> on, off;
  for (const auto* run : runs_of(question.ladder))
    if (run->finished && run->step > 0.0 && std::isfinite(run->u_error))
      (off_grid(question.motion, run->step) < near ? on : off).push_back(run);
  if (on.empty()) return;
  const double share = double(on.size()) / double(on.size() + off.size());
  auto one = diagnosis_of(Code("commensurate-steps"), share, "1");
  if (off.empty()) {
    if (on.size() < 2 || (question.displacement.has_line && are_located(question))) return;
    one.confidence = 0.6;
  } else {
    int lucky = 0;
    for (const auto* run : on) {
      std::vector<double> beside;
      for (const auto* other : off)
        if (std::abs(std::log2(other->step / run->step)) <= 1.05) beside.push_back(other->u_error);
      lucky += (impacts_at_steps && off_grid(question.motion, run->step) < divides) ||
               (!beside.empty() && run->u_error < 0.1 * measure::median(beside));
    }
    if (2 * lucky <= std::ssize(on)) return;
    one.confidence = on.size() >= 2 ? 0.95 : 0.8;
  }
  one.evidence = {{"share", share}, {"step", on.back()->step}};
  // Contacts may close together.
  const double apart = known >= 2 ? question.motion.impact(2).t - question.motion.impact(1).t : 0.0;
  if (apart > 0.0) one.evidence.push_back({"time", apart});
  found.push_back(std::move(one));
}

// Runs at the coarse end that failed or left all bounds, and finer ones that did not.
void unstable(const DiagnosisInput& question, std::vector<Diagnosis>& found) {
  if (question.by_tolerance) return;
  auto runs = runs_of(question.ladder);
  std::ranges::stable_sort(runs, std::greater{}, &measure::RunScore::step);
  // Errors of bounded motions stay near 2: both amplitudes in opposite phase.
  constexpr double exploded = 10.0;
  const auto fails = [](const measure::RunScore* run) {
    return !run->finished || !(run->u_error < exploded);
  };
  const auto first_stable = std::ranges::find_if_not(runs, fails);
  if (first_stable == runs.begin() || first_stable == runs.end()) return;
  if (std::any_of(first_stable, runs.end(), fails)) return;
  const bool grew = std::any_of(runs.begin(), first_stable, [](const measure::RunScore* run) {
    return run->finished || run->failure_code == "diverged" || run->failure_code == "not-finite" ||
           run->failure_code == "not-a-number";
  });
  auto one = diagnosis_of(Code("unstable-coarse-steps"), (*first_stable)->step, "s");
  one.confidence = grew ? 0.9 : 0.6;
  one.evidence = {{"step", (*(first_stable - 1))->step},
                  {"share", double(first_stable - runs.begin()) / double(runs.size())}};
  found.push_back(std::move(one));
}

}  // namespace

std::vector<Diagnosis> step_causes(const DiagnosisInput& question, bool impacts_at_steps) {
  std::vector<Diagnosis> found;
  commensurate(question, impacts_at_steps, found);
  unstable(question, found);
  return found;
}

}  // namespace clackers::diagnose
