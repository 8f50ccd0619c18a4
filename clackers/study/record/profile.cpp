#include "clackers/study/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/study/record.hpp"

namespace clackers::study {
namespace {

constexpr double failed = std::numeric_limits<double>::infinity();
constexpr int smallest_decade = 16;  // below 1e-16 of the envelope nothing is measured

void add_tasks(assess::CostTable& table, const CaseRecord& record, assess::Counter counter) {
  std::vector<assess::WorkCurve> curves;
  for (const auto& subject : record.subjects)
    curves.push_back(assess::work_curve(ladder_of(subject), counter));
  for (int decade = 1; decade <= smallest_decade; ++decade) {
    const double error = std::pow(10.0, -decade);
    std::vector<double> costs;
    for (const auto& curve : curves)
      costs.push_back(assess::work_for(curve, error).value_or(failed));
    // A smaller error is not reached either.
    if (std::ranges::all_of(costs, [](double cost) { return cost == failed; })) return;
    table.tasks.push_back(fmt::format("{}: error in u <= {:.0e}", record.problem.name, error));
    for (std::size_t i = 0; i < costs.size(); ++i) table.costs[i].push_back(costs[i]);
  }
}

bool has_profile(const assess::CostTable& table) {
  const auto free = [](double cost) { return !(cost > 0.0); };
  return !table.tasks.empty() && std::ranges::none_of(table.costs, [&](const auto& row) {
    return std::ranges::any_of(row, free);
  });
}

}  // namespace

std::string_view field_of(assess::Counter counter) {
  switch (counter) {
    case assess::Counter::steps:
      return "steps";
    case assess::Counter::force_evaluations:
      return "force_evaluations";
    case assess::Counter::factorizations:
      return "factorizations";
    case assess::Counter::newton_iterations:
      return "newton_iterations";
    case assess::Counter::event_searches:
      return "event_searches";
    case assess::Counter::seconds:
      break;
  }
  return "seconds";
}

std::vector<Profile> profiles_of(std::span<const CaseRecord> cases) {
  std::vector<Profile> profiles;
  const auto is_interrupted = [](const CaseRecord& one) { return counts(one).interrupted > 0; };
  if (cases.empty() || std::ranges::any_of(cases, is_interrupted)) return profiles;
  for (const auto counter : assess::all_counters) {
    if (counter == assess::Counter::seconds) continue;
    assess::CostTable table;
    for (const auto& subject : cases.front().subjects) table.methods.push_back(subject.name);
    table.costs.resize(table.methods.size());
    for (const auto& one : cases) add_tasks(table, one, counter);
    if (!has_profile(table)) continue;
    auto methods = assess::performance_profile(table);
    profiles.push_back(
        {std::string(field_of(counter)), std::move(table.tasks), std::move(methods)});
  }
  return profiles;
}

}  // namespace clackers::study
