#include "clackers/diagnose/causes.hpp"

namespace clackers::diagnose {

std::vector<Diagnosis> system_causes(const Question&) { return {}; }

}  // namespace clackers::diagnose
