#include "clackers/report/atlas/survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/report/format.hpp"

namespace clackers::report {
namespace {

constexpr std::string_view set_prefix = "set_";
constexpr long long most_levels = 1000;

std::string cell_text(const record::Cell& cell) {
  if (const auto* real = std::get_if<double>(&cell)) return exact_number(*real);
  if (const auto* whole = std::get_if<long long>(&cell)) return fmt::format("{}", *whole);
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return {};
}

SurveySystem system_of(const record::Sheet& sheet, const std::vector<record::Cell>& row,
                       const NamedCells& cells) {
  SurveySystem system{cells.text(row, "case"), {}};
  for (std::size_t c = 0; c < sheet.columns.size(); ++c)
    if (sheet.columns[c].name.starts_with(set_prefix) && row[c].index() != 0)
      system.settings.emplace_back(sheet.columns[c].name.substr(set_prefix.size()), row[c]);
  return system;
}

// The same of two parts whose columns stand in different orders.
std::string key_of(SurveySystem system) {
  std::ranges::sort(system.settings, {}, &std::pair<std::string, record::Cell>::first);
  return system.name + ' ' + system.settings_text();
}

template <class Item>
std::size_t place_of(std::vector<Item>& list, std::map<std::string, std::size_t>& known,
                     const std::string& key, Item item) {
  const auto [found, is_new] = known.try_emplace(key, list.size());
  if (is_new) list.push_back(std::move(item));
  return found->second;
}

measure::RunScore run_of(const std::vector<record::Cell>& row, const NamedCells& cells) {
  measure::RunScore run;
  run.step = cells.number(row, "step");
  if (std::isnan(run.step)) run.step = cells.number(row, "tolerance");
  run.finished = cells.text(row, "finished") == "yes";
  run.u_error = cells.number(row, "u_error");
  run.work.steps = cells.whole(row, "steps");
  run.work.force_evaluations = cells.whole(row, "force_evaluations");
  return run;
}

// Runs come by their tasks in any order, the runs of a task coarsest first.
void read_runs(const AtlasPart& part, const std::map<long long, std::size_t>& place_of_task,
               std::vector<SurveySubject>& subjects) {
  const NamedCells cells(part.runs->columns());
  std::vector<record::Cell> row;
  while (part.runs->next(row)) {
    const auto level = cells.whole(row, "level");
    const auto found = place_of_task.find(cells.whole(row, "task"));
    if (found == place_of_task.end() || level < 1) continue;  // a refusal is a row without a level
    if (level > most_levels)
      refuse("atlas", "level", double(level), fmt::format("1 to {}", most_levels));
    auto& subject = subjects[found->second];
    subject.by_tolerance = !cells.text(row, "tolerance").empty();
    if (subject.ladder.size() < std::size_t(level)) subject.ladder.resize(std::size_t(level));
    auto& runs = subject.ladder[std::size_t(level - 1)];
    runs.runs.push_back(run_of(row, cells));
    runs.step = runs.runs.front().step;
  }
}

}  // namespace

std::string SurveySystem::settings_text() const {
  std::string out;
  for (const auto& [key, value] : settings)
    out += fmt::format("{}{}={}", out.empty() ? "" : ",", key, cell_text(value));
  return out;
}

NamedCells::NamedCells(const std::vector<record::Column>& columns) {
  for (std::size_t c = 0; c < columns.size(); ++c) places_.try_emplace(columns[c].name, c);
}

const record::Cell* NamedCells::find(const std::vector<record::Cell>& row,
                                     const std::string& column) const {
  const auto found = places_.find(column);
  return found == places_.end() || row[found->second].index() == 0 ? nullptr : &row[found->second];
}

std::string NamedCells::text(const std::vector<record::Cell>& row,
                             const std::string& column) const {
  const auto* cell = find(row, column);
  return cell == nullptr ? std::string() : cell_text(*cell);
}

double NamedCells::number(const std::vector<record::Cell>& row, const std::string& column) const {
  const auto* cell = find(row, column);
  if (cell == nullptr) return std::nan("");
  if (const auto* whole = std::get_if<long long>(cell)) return double(*whole);
  const auto* real = std::get_if<double>(cell);
  return real == nullptr ? std::nan("") : *real;
}

long long NamedCells::whole(const std::vector<record::Cell>& row, const std::string& column) const {
  const double value = number(row, column);
  return std::isfinite(value) ? static_cast<long long>(value) : 0;
}

Survey survey_of(std::span<const AtlasPart> parts) {
  Survey survey;
  std::map<std::string, std::size_t> systems, methods;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto& sheet = *parts[p].subjects;
    const NamedCells cells(sheet.columns);
    std::map<long long, std::size_t> place_of_task;
    std::map<std::pair<std::size_t, std::size_t>, bool> seen;
    for (std::size_t r = 0; r < sheet.rows.size(); ++r) {
      const auto& row = sheet.rows[r];
      const auto system = system_of(sheet, row, cells);
      const auto name = cells.text(row, "method");
      SurveySubject subject;
      subject.system = place_of(survey.systems, systems, key_of(system), system);
      subject.method = place_of(survey.methods, methods, fmt::format("{} {}", p, name),
                                SurveyMethod{name, cells.text(row, "treatment"), p});
      subject.part = p;
      subject.row = r;
      if (!seen.try_emplace({subject.method, subject.system}, true).second)
        throw InputError(
            fmt::format("atlas: {} appears twice on {} {}; allowed: a method once on each system.",
                        name, system.name, system.settings_text()),
            "bad-syntax");
      place_of_task[cells.whole(row, "task")] = survey.subjects.size();
      survey.subjects.push_back(std::move(subject));
    }
    read_runs(parts[p], place_of_task, survey.subjects);
  }
  if (survey.subjects.empty())
    throw InputError(
        "atlas: no method was run on any system; allowed: at least one finished task. "
        "Run the campaign first: clackers campaign run SPEC.toml",
        "not-a-campaign");
  return survey;
}

}  // namespace clackers::report
