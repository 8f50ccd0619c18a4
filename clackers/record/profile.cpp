#include "clackers/record/profile.hpp"

#include <algorithm>

#include "clackers/judge/cost/performance_profile.hpp"
#include "clackers/record/record.hpp"

namespace clackers::record {

std::string_view field_of(judge::Counter counter) {
  switch (counter) {
    case judge::Counter::steps:
      return "steps";
    case judge::Counter::force_evaluations:
      return "force_evaluations";
    case judge::Counter::factorizations:
      return "factorizations";
    case judge::Counter::newton_iterations:
      return "newton_iterations";
    case judge::Counter::event_searches:
      return "event_searches";
    case judge::Counter::seconds:
      break;
  }
  return "seconds";
}

std::vector<Profile> profiles_of(std::span<const CaseRecord> cases) {
  std::vector<Profile> profiles;
  const auto is_interrupted = [](const CaseRecord& problem) {
    return counts(problem).interrupted > 0;
  };
  if (cases.empty() || std::ranges::any_of(cases, is_interrupted)) return profiles;
  for (const auto counter : judge::all_counters) {
    if (counter == judge::Counter::seconds) continue;
    judge::CostTable table;
    for (const auto& subject : cases.front().subjects) table.methods.push_back(subject.name);
    table.costs.resize(table.methods.size());
    for (const auto& problem : cases) {
      std::vector<measure::Ladder> ladders;
      for (const auto& subject : problem.subjects) ladders.push_back(ladder_of(subject));
      judge::add_tasks(table, problem.problem.name, ladders, counter);
    }
    if (!judge::has_ratios(table)) continue;
    auto methods = judge::performance_profile(table);
    profiles.push_back(
        {std::string(field_of(counter)), std::move(table.tasks), std::move(methods)});
  }
  return profiles;
}

}  // namespace clackers::record
