#include <algorithm>
#include <array>
#include <iterator>

#include "clackers/diagnose/ladder/ladder_families.hpp"

namespace clackers::diagnose {

std::vector<Diagnosis> ladder_causes(const Question& question) {
  constexpr std::array families{limit_causes, location_causes, noise_causes,
                                step_causes,  tension_causes,  energy_causes};
  std::vector<Diagnosis> all;
  for (const auto find : families) std::ranges::move(find(question), std::back_inserter(all));
  return all;
}

}  // namespace clackers::diagnose
