#include "clackers/assess/metrics/collision_period.hpp"

namespace clackers::assess {

double collision_period(const model::Motion& reference) {
  if (reference.impact_count(reference.end()) < 2) return reference.end();
  return reference.impact(2).t - reference.impact(1).t;
}

}  // namespace clackers::assess
