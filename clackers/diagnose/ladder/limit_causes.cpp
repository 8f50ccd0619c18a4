#include <cmath>

#include "clackers/diagnose/ladder/ladder_families.hpp"

namespace clackers::diagnose {

std::vector<Diagnosis> limit_causes(const Limit& limit) {
  if (!limit.wrong) return {};
  auto found = diagnosis_of(Code("wrong-limit"), limit.distance, "1");
  found.confidence = limit.files >= 3 ? 0.95 : 0.8;
  if (std::isfinite(limit.order)) found.evidence.push_back({"order", limit.order});
  found.evidence.push_back({"files", double(limit.files)});
  return {found};
}

}  // namespace clackers::diagnose
