#include "clackers/judge/cost/performance_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/error.hpp"

namespace clackers::judge {
namespace {

constexpr auto profile_name = "performance profile";
constexpr double failure = std::numeric_limits<double>::infinity();

void validate(const CostTable& table) {
  if (table.tasks.empty())
    refuse(profile_name, "number of tasks", 0.0, "at least 1", {}, "wrong-size");
  if (table.costs.size() != table.methods.size())
    refuse(profile_name, "number of rows", double(table.costs.size()), "one a method", {},
           "wrong-size");
  for (const auto& row : table.costs) {
    if (row.size() != table.tasks.size())
      refuse(profile_name, "number of costs in a row", double(row.size()), "one a task", {},
             "wrong-size");
    for (const double cost : row)
      if (cost <= 0.0)
        refuse(profile_name, "cost", cost, "above 0; NaN or infinite for a failure",
               "Choose a counter that every method has.");
  }
}

std::vector<ProfileStep> steps_of(std::vector<double> ratios) {
  const double tasks = double(ratios.size());
  std::ranges::sort(ratios);
  std::vector<ProfileStep> steps;
  for (std::size_t i = 0; i < ratios.size() && ratios[i] < failure; ++i) {
    const double share = double(i + 1) / tasks;
    if (!steps.empty() && steps.back().ratio == ratios[i])
      steps.back().share = share;
    else
      steps.push_back({ratios[i], share});
  }
  return steps;
}

}  // namespace

std::vector<MethodProfile> performance_profile(const CostTable& table) {
  validate(table);
  std::vector<MethodProfile> methods;
  for (const auto& name : table.methods) {
    methods.emplace_back();
    methods.back().method = name;
  }
  for (std::size_t task = 0; task < table.tasks.size(); ++task) {
    double least = failure;
    for (const auto& row : table.costs)
      if (row[task] < least) least = row[task];
    for (std::size_t i = 0; i < table.methods.size(); ++i) {
      const double cost = table.costs[i][task];
      const bool solved = std::isfinite(cost);
      auto& method = methods[i];
      method.ratios.push_back(solved ? cost / least : failure);
      method.best += solved && cost == least;
      method.failed += !solved;
    }
  }
  for (auto& method : methods) method.steps = steps_of(method.ratios);
  return methods;
}

double share_within(const MethodProfile& profile, double ratio) {
  if (!(ratio >= 1.0)) refuse(profile_name, "ratio", ratio, "1 or more");
  double share = 0.0;
  for (const auto& step : profile.steps)
    if (step.ratio <= ratio) share = step.share;
  return share;
}

}  // namespace clackers::judge
