#include "clackers/methods/method.hpp"

namespace clackers::methods {

double Method::contact_time(const model::ImpactProblem<>&) const { return 0.0; }

}  // namespace clackers::methods
