#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

#include "clackers/diagnose/ladder/ladder_families.hpp"
#include "clackers/diagnose/ladder/located_causes.hpp"
#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::diagnose {
namespace {

// Whether masses fly on freely through the contact from this impact of the reference until it opens.
bool flies_through(const model::Trajectory& rows, const model::MotionImpact& impact,
                   const DiagnosisInput& question) {
  constexpr double largest_lack = 0.02;
  if (rows.v.empty()) return false;
  const measure::FreeMotion motion(question.problem.system);
  const auto& contact = question.problem.contacts[std::size_t(impact.contact)];
  const auto first = std::size_t(std::ranges::upper_bound(rows.t, impact.t) - rows.t.begin());
  double closing = 0.0;
  for (auto row = first; row > 0 && row < rows.t.size(); ++row) {
    const auto from = measure::row_state(rows, row - 1), to = measure::row_state(rows, row);
    if (row == first) closing = -contact.gap_rate(from.v);
    const auto moved = motion.moved(from, to.t - from.t);
    if (!(std::abs(contact.gap_rate(moved.v - to.v)) < largest_lack * closing)) return false;
    if (contact.gap_at(to.u) > 0.0) return row > first + 1;
  }
  return false;
}

// The impact at which the finest histories leave the reference, where it was not applied in them.
std::optional<Diagnosis> missed(const DiagnosisInput& question) {
  const auto& left = question.limit.departure;
  if (!left || left->impact == 0 || question.histories.size() < 2) return {};
  const auto impact = question.motion.impact(left->impact);
  if (impact.contact < 0) return {};
  for (const auto& seen : question.histories.last(2))
    if (!flies_through(seen.sample, impact, question)) return {};
  auto found = diagnosis_of(Code("impact-missed"), double(left->impact), "1");
  found.confidence = 0.95;
  found.evidence = {{"time", impact.t}, {"files", 2.0}};
  return found;
}

// Whether the reference stays in contact for as long.
bool lasts_as_true(const LocatedImpact& impact, const model::Motion& motion) {
  return std::ranges::any_of(motion.closed_contacts(), [&](const model::ClosedContact& closed) {
    const double common =
        std::min(impact.t + impact.duration, closed.until) - std::max(impact.t, closed.from);
    return closed.contact == impact.contact &&
           common >= 0.5 * std::max(impact.duration, closed.until - closed.from);
  });
}

// Contacts of one duration in all files that hold several rows of it, the finest among them.
std::optional<Diagnosis> compliant(const DiagnosisInput& question,
                                   const std::vector<LocatedImpacts>& files) {
  std::vector<double> durations;
  LocatedImpacts resolved;
  double speed = 0.0;
  int resolving = 0;
  bool finest_resolves = false;
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::vector<double> one;
    double fastest = 0.0;
    for (const auto& impact : files[i].impacts) {
      one.push_back(impact.duration);
      fastest = std::max(fastest, impact.closing);
    }
    finest_resolves =
        !one.empty() && measure::median(one) >= 3.0 * question.histories[i].facts.spacing;
    if (!finest_resolves) continue;
    ++resolving;
    speed = fastest;
    durations.push_back(measure::median(one));
    std::ranges::copy(files[i].impacts, std::back_inserter(resolved.impacts));
  }
  if (!finest_resolves || resolved.is_rigid()) return {};
  const double duration = durations.back();
  const auto alike = std::ranges::count_if(
      durations, [&](double x) { return std::abs(x / duration - 1.0) < 0.2; });
  if (2 * alike < std::ssize(durations)) return {};
  const double w = std::numbers::pi / duration;
  auto found = diagnosis_of(Code("contact-compliant"), duration, "s");
  found.confidence = resolving >= 2 ? 0.9 : 0.75;
  found.evidence = {{"penetration", speed / w}};
  if (question.problem.contacts.size() == 1) {
    const auto& contact = question.problem.contacts.front();
    const Eigen::VectorXd push = numerics::solved(question.problem.system.mass, contact.direction);
    const double mass = 1.0 / contact.direction.dot(push);
    found.evidence.push_back({"stiffness", mass * w * w});
  }
  found.evidence.push_back({"files", double(resolving)});
  return found;
}

}  // namespace

std::vector<Diagnosis> location_causes(const DiagnosisInput& question) {
  std::vector<LocatedImpacts> all;
  for (const auto& seen : question.histories) {
    all.push_back(locate_impacts(seen, question.problem, question.by_tolerance));
    std::erase_if(all.back().impacts, [&](const LocatedImpact& impact) {
      return lasts_as_true(impact, question.motion);
    });
  }
  if (auto found = not_started(question)) return {*std::move(found)};
  if (auto found = missed(question)) return {*std::move(found)};
  if (auto found = compliant(question, all)) return {*std::move(found)};
  if (std::ranges::all_of(all, [](const auto& file) { return file.impacts.empty(); })) return {};
  return delay_causes(question, std::move(all));
}

}  // namespace clackers::diagnose
