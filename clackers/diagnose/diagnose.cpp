#include "clackers/diagnose/diagnose.hpp"

#include <algorithm>
#include <functional>
#include <vector>

#include "clackers/diagnose/causes.hpp"

namespace clackers::diagnose {
namespace {

bool is_unreadable(const Diagnosis& found) {
  return find_cause(found.code)->group == CauseGroup::reading;
}

void add(std::vector<Diagnosis>& all, std::vector<Diagnosis> more) {
  for (auto& one : more) {
    if (!(one.confidence >= least_confidence)) continue;
    const auto same = std::ranges::find(all, one.code, &Diagnosis::code);
    if (same == all.end())
      all.push_back(std::move(one));
    else if (same->confidence < one.confidence)
      *same = std::move(one);
  }
}

}  // namespace

std::vector<Diagnosis> diagnose(const DiagnosisInput& question) {
  std::vector<Diagnosis> found;
  if (!question.is_this_system) add(found, file_causes(question));
  const bool is_readable = std::ranges::none_of(found, is_unreadable);
  if (is_readable) {
    if (!question.is_this_system) add(found, system_causes(question));
    add(found, ladder_causes(question));
  }
  std::vector<Diagnosis> kept;
  std::ranges::copy_if(found, std::back_inserter(kept), [&](const Diagnosis& implied) {
    return std::ranges::none_of(
        found, [&](const Diagnosis& cause) { return brings_about(cause, implied); });
  });
  std::ranges::stable_sort(kept, std::greater{}, &Diagnosis::confidence);
  return kept;
}

}  // namespace clackers::diagnose
