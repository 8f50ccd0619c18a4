#include "clackers/diagnose/diagnose.hpp"

namespace clackers::diagnose {

std::optional<Diagnosis> diagnose_start(const Opening&, const model::ImpactProblem<>&,
                                        const model::Motion&) {
  return {};
}

}  // namespace clackers::diagnose
