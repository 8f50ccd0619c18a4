#include "clackers/report/counters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "clackers/assess/cost/work_precision.hpp"

namespace clackers::report {
namespace {

ShownCounter shown(assess::Counter counter) {
  if (counter == assess::Counter::seconds) return {study::field_of(counter), "processor time [s]"};
  return {study::field_of(counter), std::string(to_string(counter))};
}

bool counted(const study::Record& record, assess::Counter counter) {
  for (const auto& method : record.methods)
    for (const auto& level : method.ladder)
      for (const auto& run : level.runs)
        if (run.finished && assess::cost(run, counter) > 0.0) return true;
  return false;
}

}  // namespace

std::vector<ShownCounter> counters_of(const study::Record& record) {
  std::vector<ShownCounter> list;
  for (const auto counter : assess::all_counters)
    if (counted(record, counter)) list.push_back(shown(counter));
  return list;
}

std::vector<ShownCounter> counters_of(const std::vector<study::Profile>& profiles) {
  std::vector<ShownCounter> list;
  for (const auto counter : assess::all_counters)
    if (std::ranges::count(profiles, study::field_of(counter), &study::Profile::counter) > 0)
      list.push_back(shown(counter));
  return list;
}

ShownCounter first_shown(const std::vector<ShownCounter>& counters) {
  if (counters.empty()) throw std::logic_error("a figure of work without a counter");
  const auto forces = std::ranges::find(
      counters, study::field_of(assess::Counter::force_evaluations), &ShownCounter::field);
  return forces == counters.end() ? counters.front() : *forces;
}

std::string counter_choice(const std::vector<ShownCounter>& counters, std::string_view figure) {
  if (counters.size() < 2) return {};
  const auto first = first_shown(counters).field;
  std::string out = "<div class=\"tools\" role=\"group\" aria-label=\"What the figure counts\">\n";
  for (const auto& [field, title] : counters)
    out += fmt::format(
        "<button type=\"button\" data-counter=\"{}\" data-of=\"{}\" "
        "aria-pressed=\"{}\">{}</button>\n",
        field, figure, field == first ? "true" : "false", title);
  return out + "</div>\n";
}

}  // namespace clackers::report
