#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <deque>
#include <filesystem>

#include "clackers/base/error.hpp"
#include "clackers/base/files/files.hpp"
#include "clackers/base/text.hpp"
#include "clackers/campaign/atlas.hpp"
#include "clackers/report/atlas.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::campaign {
namespace {

std::string heading_of(const Store& store, const std::string& command) {
  if (command == "atlas") return "Atlas of methods through impacts";
  return fmt::format("Campaign {}", std::filesystem::path(store.path()).stem().string());
}

std::string lead_of(const Store& store, std::size_t others) {
  const auto& specification = store.specification();
  const auto finished = store.finished().size();
  auto lead =
      fmt::format("{} on {}.", report::counted(std::ssize(specification.methods()), "method"),
                  report::counted(specification.systems(), "system"));
  if (finished < specification.tasks())
    lead += fmt::format(" {} of {} tasks are finished.", finished, specification.tasks());
  if (others > 0)
    lead +=
        fmt::format(" With {} of others.", report::counted(static_cast<long long>(others), "file"));
  return lead;
}

std::string call_of(const MethodEntry& entry, const std::string& name) {
  auto call = fmt::format("--exec {} --name {}", shell_quoted(entry.text), shell_quoted(name));
  if (!entry.expect.empty()) call += " --expect " + shell_quoted(entry.expect);
  return call;
}

bool is_cell(const record::Cell& cell, const ParameterValue& value) {
  if (value.is_word()) return cell == record::Cell(value.text());
  const auto* whole = std::get_if<long long>(&cell);
  return cell == record::Cell(double(value)) ||
         (whole != nullptr && double(*whole) == double(value));
}

// Whether a row names this method and this system, and nothing else: a page makes commands of it.
bool is_task(const record::Sheet& subjects, const std::vector<record::Cell>& row,
             const MethodEntry& method, const System& system) {
  for (std::size_t c = 0; c < row.size(); ++c) {
    const auto& name = subjects.columns[c].name;
    if (name == "case" && row[c] != record::Cell(std::string(system.name))) return false;
    if (name == "method" && row[c] != record::Cell(method.name) && !method.name.empty())
      return false;
    if (!name.starts_with("set_")) continue;
    const auto set =
        std::ranges::find(system.settings, name.substr(4), &Settings::value_type::first);
    if (set == system.settings.end() ? row[c].index() != 0 : !is_cell(row[c], set->second))
      return false;
  }
  return true;
}

// How a command line names the programs of a specification, by their names in the rows of `subjects`,
// each of which is a task of the specification.
std::map<std::string, std::string> calls_of(const Specification& specification,
                                            const record::Sheet& subjects,
                                            const std::string& path) {
  std::map<std::string, std::string> calls;
  const auto& methods = specification.methods();
  const auto place_of = [&](const char* name) {
    return std::size_t(std::ranges::find(subjects.columns, name, &record::Column::name) -
                       subjects.columns.begin());
  };
  const auto task = place_of("task"), method = place_of("method");
  for (const auto& row : subjects.rows) {
    const auto* number = std::get_if<long long>(&row.at(task));
    const bool is_known = number != nullptr && *number >= 0 && *number < specification.tasks();
    const auto count = static_cast<long long>(methods.size());
    if (!is_known || !is_task(subjects, row, methods[std::size_t(*number % count)],
                              specification.system(*number / count)))
      throw InputError(
          fmt::format("{}: a row of subjects is no task of the specification beside it.", path),
          "not-a-campaign");
    const auto& entry = methods[std::size_t(*number % count)];
    const auto* name = std::get_if<std::string>(&row.at(method));
    if (entry.kind != MethodEntry::Kind::catalogue && name != nullptr)
      calls.try_emplace(*name, call_of(entry, *name));
  }
  return calls;
}

record::Sheet sheet_of(record::RowSource& rows) {
  record::Sheet sheet{rows.schema(), rows.title(), rows.columns(), {}};
  for (std::vector<record::Cell> row; rows.next(row);) sheet.rows.push_back(row);
  return sheet;
}

// A database with what the page reads of it.
struct Part {
  explicit Part(const Store& store)
      : subjects(sheet_of(*store.rows(TableName::subjects))), runs(store.rows(TableName::runs)) {
    const auto& specification = store.specification();
    auto [author, from] = store.origin();
    part = {&subjects,
            runs.get(),
            store.path(),
            author,
            std::move(from),
            ladder_options(specification.ladder()),
            calls_of(specification, subjects, store.path())};
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  record::Sheet subjects;
  std::unique_ptr<record::RowSource> runs;
  report::AtlasPart part;
};

}  // namespace

std::string ladder_options(const Ladder& ladder) {
  std::string options;
  const auto add = [&](const std::string& text) { options += (options.empty() ? "" : " ") + text; };
  if (ladder.levels) add(fmt::format("--levels {}", *ladder.levels));
  if (ladder.samples_per_level)
    add(fmt::format("--samples-per-level {}", *ladder.samples_per_level));
  if (ladder.coarsest) add("--coarsest " + exact_number(*ladder.coarsest));
  if (!ladder.tolerances.empty()) {
    std::vector<std::string> list;
    for (const double tolerance : ladder.tolerances) list.push_back(exact_number(tolerance));
    add(fmt::format("--tolerances {}", fmt::join(list, ",")));
  }
  if (!ladder.levels) add("--budget 0");  // a campaign never refines beyond its ladder
  return options;
}

void require_results(const Store& store) {
  if (const auto size = std::filesystem::file_size(store.path()); size > longest_file)
    refuse(store.path(), "size", fmt::format("{} bytes", size),
           fmt::format("up to {}", longest_file));
  report::require_few_cells(store.finished().size());
  const Part other(store);
  report::atlas_page({&other.part, 1}, {});
}

std::string campaign_page(const Store& store, std::span<const Store> others,
                          const std::string& command, const record::Provenance& from) {
  report::require_few_cells(store.finished().size());  // before they are read
  std::deque<Part> read;
  read.emplace_back(store).part.from = from;
  for (const auto& other : others) read.emplace_back(other);
  std::vector<report::AtlasPart> parts;
  for (const auto& [subjects, runs, part] : read) parts.push_back(part);
  return report::atlas_page(parts,
                            {command, heading_of(store, command), lead_of(store, others.size()),
                             store.specification().text(), from});
}

}  // namespace clackers::campaign
