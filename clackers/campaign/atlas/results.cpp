#include "clackers/campaign/atlas/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "clackers/base/text.hpp"
#include "clackers/report/columns.hpp"
#include "clackers/report/format.hpp"

namespace clackers::campaign {
namespace {

std::string call_of(const MethodEntry& entry, const std::string& name) {
  auto call = fmt::format("--exec {} --name {}", shell_quoted(entry.text),
                          shell_quoted(name));
  if (!entry.expect.empty()) call += " --expect " + shell_quoted(entry.expect);
  return call;
}

std::size_t place_of(const std::vector<record::Column>& columns, const std::string& name) {
  return std::size_t(std::ranges::find(columns, name, &record::Column::name) - columns.begin());
}

// Without the columns of subjects, which stand in the other sheet.
record::Sheet runs_alone(record::RowSource& rows) {
  std::vector<std::size_t> kept;
  const auto& columns = rows.columns();
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const auto found = std::ranges::find(report::columns(), columns[c].name, &report::Column::name);
    const bool is_run = found != report::columns().end() && !report::is_of_subject(*found);
    if (is_run || columns[c].name == "task" || columns[c].name == "run") kept.push_back(c);
  }
  record::Sheet sheet{rows.schema(), rows.title(), {}, {}};
  for (const auto c : kept) sheet.columns.push_back(columns[c]);
  for (std::vector<record::Cell> row; rows.next(row);) {
    auto& cells = sheet.rows.emplace_back();
    for (const auto c : kept) cells.push_back(std::move(row[c]));
  }
  return sheet;
}

}  // namespace

std::string ladder_options(const Ladder& ladder) {
  std::string options;
  const auto add = [&](const std::string& text) { options += (options.empty() ? "" : " ") + text; };
  if (ladder.levels) add(fmt::format("--levels {}", *ladder.levels));
  if (ladder.samples_per_level)
    add(fmt::format("--samples-per-level {}", *ladder.samples_per_level));
  if (ladder.coarsest) add("--coarsest " + report::exact_number(*ladder.coarsest));
  if (!ladder.tolerances.empty()) {
    std::vector<std::string> list;
    for (const double one : ladder.tolerances) list.push_back(report::exact_number(one));
    add(fmt::format("--tolerances {}", fmt::join(list, ",")));
  }
  if (!ladder.levels) add("--budget 0");  // a campaign never refines beyond its ladder
  return options;
}

std::map<std::string, std::string> calls_of(const Specification& specification,
                                            const record::Sheet& subjects) {
  std::map<std::string, std::string> calls;
  const auto& methods = specification.methods();
  const auto task = place_of(subjects.columns, "task");
  const auto method = place_of(subjects.columns, "method");
  for (const auto& row : subjects.rows) {
    const auto& entry = methods[std::size_t(std::get<long long>(row.at(task))) % methods.size()];
    const auto* name = std::get_if<std::string>(&row.at(method));
    if (entry.kind == MethodEntry::Kind::catalogue || name == nullptr) continue;
    calls.try_emplace(*name, call_of(entry, *name));
  }
  return calls;
}

record::Sheet sheet_of(record::RowSource& rows) {
  record::Sheet sheet{rows.schema(), rows.title(), rows.columns(), {}};
  for (std::vector<record::Cell> row; rows.next(row);) sheet.rows.push_back(row);
  return sheet;
}

AtlasResults results_of(const Store& store, const std::string& origin,
                        const record::Provenance& from) {
  const auto& specification = store.specification();
  AtlasResults results;
  results.origin = origin;
  results.from = from;
  results.options = ladder_options(specification.ladder());
  results.specification = specification.text();
  results.subjects = sheet_of(*store.rows(TableName::subjects));
  results.runs = runs_alone(*store.rows(TableName::runs));
  results.calls = calls_of(specification, results.subjects);
  return results;
}

}  // namespace clackers::campaign
