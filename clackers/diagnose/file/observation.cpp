#include "clackers/diagnose/observation.hpp"

namespace clackers::diagnose {

Observation observe(const assess::Comparison& comparison, const FileFacts& facts) {
  Observation seen;
  seen.facts = facts;
  seen.rows = (long long)(comparison.rows());
  return seen;
}

}  // namespace clackers::diagnose
