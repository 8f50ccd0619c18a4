#include "clackers/judge/cost/performance_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clackers::judge {
namespace {

constexpr double failed = std::numeric_limits<double>::infinity();
constexpr int smallest_decade = 16;  // below 1e-16 of the envelope nothing is measured

}  // namespace

void add_tasks(CostTable& table, std::string_view name, std::span<const measure::Ladder> ladders,
               Counter counter) {
  std::vector<WorkCurve> curves;
  for (const auto& ladder : ladders) curves.push_back(work_curve(ladder, counter));
  for (int decade = 1; decade <= smallest_decade; ++decade) {
    const double error = std::pow(10.0, -decade);
    std::vector<double> costs;
    for (const auto& curve : curves) costs.push_back(work_for(curve, error).value_or(failed));
    // A smaller error is not reached either.
    if (std::ranges::all_of(costs, [](double cost) { return cost == failed; })) return;
    table.tasks.push_back(fmt::format("{}: error in u <= {:.0e}", name, error));
    for (std::size_t i = 0; i < costs.size(); ++i) table.costs[i].push_back(costs[i]);
  }
}

bool has_ratios(const CostTable& table) {
  const auto free = [](double cost) { return !(cost > 0.0); };
  return !table.tasks.empty() && std::ranges::none_of(table.costs, [&](const auto& row) {
    return std::ranges::any_of(row, free);
  });
}

}  // namespace clackers::judge
