#pragma once

#include <span>
#include <string_view>

#include "clackers/judge/cost/performance_profile.hpp"
#include "clackers/judge/cost/work_precision.hpp"

namespace clackers::judge {

/// Adds to a table the tasks of one problem: the errors 0.1, 0.01, ... down to the smallest that some
/// method reaches on it, each named "NAME: error in u <= 1e-03". `ladders` has one a method of the
/// table, an empty one where it did not run; what a method needs for a task is work_for().
void add_tasks(CostTable& table, std::string_view name, std::span<const measure::Ladder> ladders,
               Counter counter);

/// Whether a profile can be made: there are tasks, and nothing costs nothing.
bool has_ratios(const CostTable& table);

}  // namespace clackers::judge
