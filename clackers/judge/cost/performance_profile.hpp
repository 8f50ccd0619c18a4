#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/judge/cost/work_precision.hpp"

namespace clackers::judge {

/// What each method costs for each task, a task being a case with a metric and an error to reach.
struct CostTable {
  std::vector<std::string> methods, tasks;
  /// A row a method, a column a task: above 0; NaN or infinite where the method failed.
  std::vector<std::vector<double>> costs;
};

/// From this ratio on, this share of all tasks is solved.
struct ProfileStep {
  double ratio = 1.0;  ///< 1 or more
  double share = 0.0;  ///< in (0, 1]
};

/// One method's line of a performance profile.
struct MethodProfile {
  std::string method;
  std::vector<double> ratios;      ///< a task each: cost over the best cost; infinite for a failure
  std::vector<ProfileStep> steps;  ///< ascending, one for each different finite ratio
  int best = 0;                    ///< tasks at which no method costs less
  int failed = 0;                  ///< tasks that it does not solve
};

/// The performance profile of E. D. Dolan and J. J. More, Math. Program. 91, 201-213 (2002). A
/// failure is an infinite ratio: it lowers the share that a line reaches and is never left out.
/// Tasks that no method solves count in all shares. Methods come in the order of the table. Throws
/// InputError for rows or columns that do not fit the names, no tasks, and costs of 0 or less, to
/// which there is no ratio.
std::vector<MethodProfile> performance_profile(const CostTable& table);

/// The share of all tasks solved within `ratio` times the best cost; infinity asks for all that are
/// solved. Throws InputError for a ratio below 1.
double share_within(const MethodProfile& profile, double ratio);

/// Adds to a table the tasks of one problem: the errors 0.1, 0.01, ... down to the smallest that some
/// method reaches on it, each named "NAME: error in u <= 1e-03". `ladders` has one a method of the
/// table, an empty one where it did not run; what a method needs for a task is work_for().
void add_tasks(CostTable& table, std::string_view name, std::span<const measure::Ladder> ladders,
               Counter counter);

/// Whether a profile can be made: there are tasks, and nothing costs nothing.
bool has_ratios(const CostTable& table);

}  // namespace clackers::judge
