#include <algorithm>
#include <cmath>
#include <iterator>

#include "clackers/diagnose/ladder/ladder_families.hpp"

namespace clackers::diagnose {

namespace {

// wrong-limit.
std::vector<Diagnosis> limit_causes(const DiagnosisInput& question) {
  const auto& limit = question.limit;
  if (!limit.wrong) return {};
  auto found = diagnosis_of(Code("wrong-limit"), limit.distance, "1");
  found.confidence = limit.files >= 3 ? 0.95 : 0.8;
  // Differences that do not fall have no order.
  constexpr double least_order = 0.5;
  if (limit.order > least_order) found.evidence.push_back({"order", limit.order});
  // Of one that is wrong nearly from the start the impact says nothing.
  constexpr double least_part_of_run = 0.05;
  if (const auto& left = limit.departure;
      left && left->impact > 0 && left->time >= least_part_of_run * question.motion.end()) {
    found.evidence.push_back({"impact", double(left->impact)});
    found.evidence.push_back({"time", left->time});
  }
  found.evidence.push_back({"files", double(limit.files)});
  return {found};
}

}  // namespace

std::vector<Diagnosis> ladder_causes(const DiagnosisInput& question) {
  std::vector<Diagnosis> all;
  const auto add = [&](std::vector<Diagnosis> found) {
    std::ranges::move(found, std::back_inserter(all));
  };
  add(limit_causes(question));
  add(force_causes(question));
  add(event_causes(question));
  add(location_causes(question));
  const bool at_steps = std::ranges::any_of(
      all, [](const Diagnosis& one) { return one.code == "impact-at-step-end"; });
  add(noise_causes(question));
  add(step_causes(question, at_steps));
  add(tension_causes(question));
  add(energy_causes(question));
  return all;
}

}  // namespace clackers::diagnose
