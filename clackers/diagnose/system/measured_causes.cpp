#include "clackers/diagnose/system/measured_causes.hpp"

#include <algorithm>
#include <iterator>

#include "clackers/diagnose/system/flight_fits.hpp"

namespace clackers::diagnose {

std::vector<Diagnosis> flight_causes(const DiagnosisInput& question,
                                     model::SmoothSystem<>* solved) {
  if (!question.problem.frictions.empty()) return {};
  const auto& finest = question.histories.back();
  const auto other = std::ranges::find_if(
      question.histories.rbegin(), question.histories.rend(), [&](const Observation& one) {
        return one.facts.step > least_other_step * finest.facts.step;
      });
  if (other == question.histories.rend()) return {};
  const auto& system = question.problem.system;
  if (system.nonlinear || system.dof() > 40) return {};
  const auto changes = changes_of(system);
  const FlightFits fits(finest, system, changes), others(*other, system, changes);
  if (!fits.known() || !others.known()) return {};
  const auto best = best_of(fits, changes);
  constexpr double sure_gain = 20.0;
  if (!best || (best->gain < sure_gain && !is_elsewhere(question))) return {};
  const auto again = others.of(best->changes);
  if (again.values.size() == 0) return {};
  const double excess = fits.excess();
  if (std::abs(excess) > same_share * best->values.cwiseAbs().maxCoeff() &&
      std::abs(others.excess() - excess) < same_share * std::abs(excess))
    return {};
  std::vector<Diagnosis> found;
  Eigen::Index at = 0;
  for (const auto change : best->changes) {
    const auto count = std::ssize(changes[change].parameters);
    const auto values = best->values.segment(at, count);
    const double apart = (again.values.segment(at, count) - values).norm();
    const double spread =
        best->uncertainty.segment(at, count).norm() + again.uncertainty.segment(at, count).norm();
    if (apart > same_share * values.norm() + spread || values.norm() < 2.0 * spread) return {};
    // No spring, damper or mass is below zero.
    constexpr double least_share = -1.05;
    if (changes[change].cause.unit == "%" && values[0] < least_share) return {};
    found.push_back(diagnosis_by(changes[change], {values.data(), std::size_t(count)},
                                 std::max(apart, best->uncertainty[at])));
    found.back().confidence = best->gain < sure_gain ? 0.85 : 0.95;
    found.back().evidence.insert(found.back().evidence.begin(), {"gain", best->gain});
    found.back().evidence.push_back({"files", 2.0});
    if (best->changes.size() > 1)
      found.back().evidence.push_back({"causes", double(best->changes.size())});
    at += count;
  }
  if (solved == nullptr) return found;
  at = 0;
  for (const auto change : best->changes)
    for (const auto& parameter : changes[change].parameters) parameter(*solved, best->values[at++]);
  return found;
}

bool is_elsewhere(const DiagnosisInput& question) {
  const auto& fit = question.displacement;
  return question.limit.wrong || fit.behaviour == Behaviour::stagnating ||
         fit.reason == Code("larger-than-motion").name();
}

std::vector<Diagnosis> measured_causes(const DiagnosisInput& question) {
  auto solved = question.problem;
  auto found = flight_causes(question, &solved.system);
  const auto& q = question;
  std::ranges::move(impact_causes({solved, q.motion, q.histories, q.ladder, q.displacement,
                                   q.velocity, q.limit, q.by_tolerance, q.is_this_system}),
                    std::back_inserter(found));
  return found;
}

}  // namespace clackers::diagnose
