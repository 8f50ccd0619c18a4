#include "clackers/assess/metrics/collision_period.hpp"

namespace clackers::assess {

double collision_period(const model::Motion& truth) {
  if (truth.impact_count(truth.end()) < 2) return truth.end();
  return truth.impact(2).t - truth.impact(1).t;
}

}  // namespace clackers::assess
