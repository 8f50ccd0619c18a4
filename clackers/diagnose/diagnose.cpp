#include "clackers/diagnose/diagnose.hpp"

#include <algorithm>
#include <functional>

#include "clackers/diagnose/causes.hpp"

namespace clackers::diagnose {

std::vector<Diagnosis> diagnose(const Question& question) {
  std::vector<Diagnosis> all;
  for (const auto find : {system_causes, file_causes, ladder_causes})
    for (auto& found : find(question))
      if (found.confidence >= least_confidence) all.push_back(std::move(found));
  std::ranges::stable_sort(all, std::greater{}, &Diagnosis::confidence);
  return all;
}

}  // namespace clackers::diagnose
