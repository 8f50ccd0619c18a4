#include "clackers/report/groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace clackers::report {
namespace {

constexpr auto worst_first = std::to_array<std::string_view>(
    {"disagrees", "undecided", "interrupted", "not claimed", "agrees", "refused"});

// Smaller is worse.
std::pair<std::ptrdiff_t, double> rank(const record::Subject* subject) {
  const auto* place = std::ranges::find(worst_first, record::verdict_word(*subject));
  const double error = record::worst_of_finest(*subject).worst.u_error;
  return {place - worst_first.begin(),
          std::isnan(error) ? -std::numeric_limits<double>::infinity() : -error};
}

}  // namespace

std::vector<SubjectGroup> groups_of(const record::CaseRecord& problem,
                                    const std::vector<std::string>& only) {
  const bool is_grouped = problem.subjects.size() > most_ungrouped;
  std::vector<SubjectGroup> groups;
  for (const auto& subject : problem.subjects) {
    if (!only.empty() && std::ranges::find(only, record::verdict_word(subject)) == only.end())
      continue;
    const auto treatment = is_grouped ? subject.treatment : std::string();
    auto group = std::ranges::find(groups, treatment, &SubjectGroup::treatment);
    if (group == groups.end()) group = groups.insert(groups.end(), {treatment, {}, is_grouped});
    group->subjects.push_back(&subject);
  }
  if (!is_grouped) return groups;
  for (auto& group : groups) std::ranges::stable_sort(group.subjects, {}, rank);
  std::ranges::stable_sort(
      groups, {}, [](const SubjectGroup& group) { return rank(group.subjects.front()).first; });
  return groups;
}

std::string heading_of(const SubjectGroup& group) {
  return fmt::format("{}, {}", group.treatment.empty() ? "standalone methods" : group.treatment,
                     counted(std::ssize(group.subjects), "method"));
}

std::string name_in(const SubjectGroup& group, const record::Subject& subject) {
  const auto end = '+' + group.treatment;
  return group.is_headed && subject.name.ends_with(end)
             ? subject.name.substr(0, subject.name.size() - end.size())
             : subject.name;
}

std::vector<NamedFinding> named_findings(
    const std::vector<SubjectGroup>& groups,
    const std::function<std::vector<Finding>(const record::Subject&)>& findings) {
  struct Place {
    std::string treatment;  // without parameters
    int others = 0;
  };
  std::vector<NamedFinding> all;
  std::vector<Place> places;
  for (const auto& group : groups) {
    const auto treatment = group.treatment.substr(0, group.treatment.find(':'));
    for (const auto* subject : group.subjects)
      for (auto& found : findings(*subject)) {
        const auto is_same = [&](std::size_t i) {
          return group.is_headed && places[i].treatment == treatment && all[i].subject != subject &&
                 all[i].finding.code == found.code &&
                 record::verdict_word(*all[i].subject) == record::verdict_word(*subject);
        };
        std::size_t i = 0;
        while (i < all.size() && !is_same(i)) ++i;
        if (i < all.size()) {
          ++places[i].others;
          continue;
        }
        all.push_back({subject, subject->name, std::move(found)});
        places.push_back({treatment});
      }
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const auto& [treatment, others] = places[i]; others > 0)
      all[i].who +=
          fmt::format(" and {} more{}{}", others, treatment.empty() ? "" : " with ", treatment);
  return all;
}

}  // namespace clackers::report
