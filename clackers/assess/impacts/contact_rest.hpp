#pragma once

#include <vector>

#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::assess {

/// Whether the true motion rests in contact number `contact` just after time t [s]: its gap and the
/// rate of it are zero, as after an impact without restitution. A time outside the motion stands
/// for the nearer end. Throws InputError unless `contact` is an index into `contacts`.
bool rests_in_contact(const model::Motion& reference, const std::vector<model::Contact<>>& contacts,
                      int contact, double t);

}  // namespace clackers::assess
