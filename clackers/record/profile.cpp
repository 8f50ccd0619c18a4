#include "clackers/record/profile.hpp"

#include <algorithm>

#include "clackers/judge/cost/profile_tasks.hpp"
#include "clackers/record/record.hpp"

namespace clackers::study {

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
    for (const auto& one : cases) {
      std::vector<assess::Ladder> ladders;
      for (const auto& subject : one.subjects) ladders.push_back(ladder_of(subject));
      assess::add_tasks(table, one.problem.name, ladders, counter);
    }
    if (!assess::has_ratios(table)) continue;
    auto methods = assess::performance_profile(table);
    profiles.push_back(
        {std::string(field_of(counter)), std::move(table.tasks), std::move(methods)});
  }
  return profiles;
}

}  // namespace clackers::study
