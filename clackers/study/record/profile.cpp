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

using Curves = std::vector<assess::WorkCurve>;

Curves curves_of(const Record& record, assess::Counter counter) {
  Curves curves;
  for (const auto& method : record.methods)
    curves.push_back(assess::work_curve(method.ladder, counter));
  return curves;
}

// What each method needs to reach an error; nothing where none reaches it.
std::vector<double> costs_of(const Curves& curves, double error) {
  std::vector<double> costs;
  for (const auto& curve : curves) costs.push_back(assess::work_for(curve, error).value_or(failed));
  if (std::ranges::all_of(costs, [](double cost) { return cost == failed; })) return {};
  return costs;
}

void add_tasks(assess::CostTable& table, const Record& record, assess::Counter counter) {
  const auto curves = curves_of(record, counter);
  for (int decade = 1; decade <= smallest_decade; ++decade) {
    const double error = std::pow(10.0, -decade);
    const auto costs = costs_of(curves, error);
    if (costs.empty()) return;  // a smaller error is not reached either
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

std::vector<Profile> profiles_of(std::span<const Record> records) {
  std::vector<Profile> profiles;
  if (records.empty() || std::ranges::any_of(records, &Record::interrupted)) return profiles;
  for (const auto counter : assess::all_counters) {
    if (counter == assess::Counter::seconds) continue;
    assess::CostTable table;
    for (const auto& method : records.front().methods) table.methods.push_back(method.name);
    table.costs.resize(table.methods.size());
    for (const auto& record : records) add_tasks(table, record, counter);
    if (!has_profile(table)) continue;
    auto found = assess::performance_profile(table);
    profiles.push_back(
        {std::string(field_of(counter)), std::move(table.tasks), std::move(found.methods)});
  }
  return profiles;
}

}  // namespace clackers::study
