#include "clackers/report/html/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "clackers/judge/cost/work_precision.hpp"
#include "clackers/report/columns.hpp"

namespace clackers::report {
namespace {

ShownCounter shown(judge::Counter counter) {
  const auto field = record::field_of(counter);
  if (counter == judge::Counter::seconds) return {counter, field, "processor time [s]"};
  return {counter, field, std::string(column(field).heading)};
}

bool is_counted(const record::CaseRecord& problem, judge::Counter counter) {
  for (const auto& subject : problem.subjects) {
    if (record::is_solver(subject.kind)) continue;
    for (const auto& level : subject.levels)
      for (const auto& run : level.runs)
        if (run.score.finished && judge::cost(run.score, counter) > 0.0) return true;
  }
  return false;
}

}  // namespace

std::vector<ShownCounter> counters_of(const record::CaseRecord& problem) {
  std::vector<ShownCounter> list;
  for (const auto counter : judge::all_counters)
    if (is_counted(problem, counter)) list.push_back(shown(counter));
  return list;
}

std::vector<ShownCounter> counters_of(const std::vector<record::Profile>& profiles) {
  std::vector<ShownCounter> list;
  for (const auto counter : judge::all_counters)
    if (std::ranges::count(profiles, record::field_of(counter), &record::Profile::counter) > 0)
      list.push_back(shown(counter));
  return list;
}

ShownCounter first_shown(const std::vector<ShownCounter>& counters) {
  if (counters.empty()) throw std::logic_error("a figure of work without a counter");
  const auto forces = std::ranges::find(
      counters, record::field_of(judge::Counter::force_evaluations), &ShownCounter::field);
  return forces == counters.end() ? counters.front() : *forces;
}

std::string counter_choice(const std::vector<ShownCounter>& counters, std::string_view figure) {
  if (counters.size() < 2) return {};
  const auto first = first_shown(counters).field;
  std::string out = "<div class=\"tools\" role=\"group\" aria-label=\"What the figure counts\">\n";
  for (const auto& [counter, field, title] : counters)
    out += fmt::format(
        "<button type=\"button\" data-counter=\"{}\" data-of=\"{}\" "
        "aria-pressed=\"{}\">{}</button>\n",
        field, figure, field == first ? "true" : "false", title);
  return out + "</div>\n";
}

}  // namespace clackers::report
