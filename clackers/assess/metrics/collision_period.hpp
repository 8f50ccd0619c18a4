#pragma once

#include "clackers/model/motion.hpp"

namespace clackers::assess {

/// The time that distances in time are divided by [s]: between the first two true impacts, or the
/// whole motion where it has fewer.
double collision_period(const model::Motion& reference);

}  // namespace clackers::assess
