#pragma once

#include "clackers/assess/errors/comparison.hpp"
#include "clackers/assess/metrics/metric.hpp"

namespace clackers::assess {

/// max(0, -g) [m] over the history's own times and all contacts, g = b . u - gap: how deep it goes
/// where the true motion cannot. Of the whole structure. Not measured without a contact.
///
/// Valid across jumps: yes, displacements do not jump. Source: common.
MetricValue penetration(const Comparison& comparison);

}  // namespace clackers::assess
