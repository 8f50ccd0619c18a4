#include "clackers/report/atlas/survey.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/base/judgement.hpp"
#include "clackers/report/format.hpp"

namespace clackers::report {
namespace {

constexpr std::string_view set_prefix = "set_";
constexpr std::size_t most_levels = 64, most_runs = 64;  // of a specification
constexpr std::size_t longest_text = 10000;              // sentences of refusals have some 300

// The words that a column may have; nothing for any text.
const std::vector<std::string>* words_of(const std::string& column) {
  static const auto behaviours = [] {
    std::vector<std::string> words;
    for (int i = 0; i <= int(Behaviour::undecided); ++i)
      words.emplace_back(to_string(Behaviour(i)));
    return words;
  }();
  static const std::vector<std::string> verdicts{"agrees",    "disagrees", "not claimed",
                                                 "undecided", "refused",   "interrupted"};
  if (column == "verdict") return &verdicts;
  return column == "behaviour" || column == "claim_behaviour" ? &behaviours : nullptr;
}

void require_short(std::string_view who, std::string_view name, std::string_view text) {
  if (text.size() > longest_text)
    refuse(who, name, fmt::format("{} bytes", text.size()), fmt::format("up to {}", longest_text));
}

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
    if (const auto& column = sheet.columns[c].name;
        column.starts_with(set_prefix) && !cells.text(row, column).empty())
      system.settings.emplace_back(column.substr(set_prefix.size()), row[c]);
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
  const NamedCells cells(part.runs->columns(), part.file + ": runs");
  std::vector<record::Cell> row;
  while (part.runs->next(row)) {
    const auto level = std::size_t(cells.whole(row, "level", double(most_levels)));
    const auto found = place_of_task.find(cells.whole(row, "task"));
    if (found == place_of_task.end() || level < 1) continue;  // a refusal is a row without a level
    auto& subject = subjects[found->second];
    subject.by_tolerance = !cells.text(row, "tolerance").empty();
    if (subject.ladder.size() < level) subject.ladder.resize(level);
    auto& runs = subject.ladder[level - 1];
    runs.runs.push_back(run_of(row, cells));
    if (runs.runs.size() > most_runs)
      refuse(cells.who(), "runs of a level", double(runs.runs.size()),
             fmt::format("up to {}", most_runs));
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

NamedCells::NamedCells(const std::vector<record::Column>& columns, std::string who)
    : who_(std::move(who)) {
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
  if (cell == nullptr) return {};
  auto text = cell_text(*cell);
  require_short(who_, column, text);
  const auto* words = words_of(column);
  if (words != nullptr && std::ranges::find(*words, text) == words->end())
    refuse(who_, column, text, fmt::format("{}", fmt::join(*words, ", ")), {}, "unknown-name");
  return text;
}

double NamedCells::number(const std::vector<record::Cell>& row, const std::string& column) const {
  const auto* cell = find(row, column);
  if (cell == nullptr) return std::nan("");
  const auto* whole = std::get_if<long long>(cell);
  const auto* real = std::get_if<double>(cell);
  if (whole == nullptr && real == nullptr)
    refuse(who_, column, fmt::format("\"{}\"", text(row, column)), "a number", {}, "not-a-number");
  const double value = whole != nullptr ? double(*whole) : *real;
  if (value < 0.0 && column != "order") refuse(who_, column, value, "0 or more");
  return value;
}

long long NamedCells::whole(const std::vector<record::Cell>& row, const std::string& column,
                            double most) const {
  const double value = number(row, column);
  if (std::isnan(value)) return 0;
  if (!(value <= most && value == std::floor(value)))
    refuse(who_, column, value, fmt::format("a whole number up to {}", most));
  return static_cast<long long>(value);
}

Survey survey_of(std::span<const AtlasPart> parts) {
  Survey survey;
  std::map<std::string, std::size_t> systems, methods;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto& sheet = *parts[p].subjects;
    const auto& from = parts[p].from;
    for (const auto* text : {&parts[p].origin, &from.command, &from.version, &from.compiler,
                             &from.machine, &from.processor, &from.date})
      require_short(parts[p].file, "a text of its origin", *text);
    const NamedCells cells(sheet.columns, parts[p].file + ": subjects");
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
