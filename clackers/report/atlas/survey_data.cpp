#include "clackers/report/atlas/survey_data.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "clackers/base/files/json.hpp"
#include "clackers/base/number.hpp"
#include "clackers/base/text.hpp"
#include "clackers/report/format.hpp"

namespace clackers::report {
namespace {

using Json = nlohmann::ordered_json;

// Four digits are finer than any screen.
Json rounded_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return rounded(value, 4);
}

// Values that repeat, each once.
class Shared {
 public:
  explicit Shared(Json& list) : list_(list) { list_ = Json::array(); }
  std::size_t place(const Json& value, const std::string& key) {
    const auto [found, is_new] = places_.try_emplace(key, list_.size());
    if (is_new) list_.push_back(value);
    return found->second;
  }
  std::size_t place(const std::string& text) { return place(valid_utf8(text), text); }

 private:
  Json& list_;
  std::map<std::string, std::size_t> places_;
};

Json settings_json(const SurveySystem& system) {
  Json out = Json::object();
  for (const auto& [key, value] : system.settings) {
    if (const auto* text = std::get_if<std::string>(&value)) out[key] = valid_utf8(*text);
    if (const auto* whole = std::get_if<long long>(&value)) out[key] = *whole;
    if (const auto* real = std::get_if<double>(&value)) out[key] = *real;
  }
  return out;
}

Json system_json(const SurveySystem& system) {
  auto command = "--case " + shell_quoted(system.name);
  if (!system.settings.empty()) command += " --set " + shell_quoted(system.settings_text());
  return {{"case", valid_utf8(system.name)},
          {"set", settings_json(system)},
          {"command", printable(command)}};
}

Json method_json(const SurveyMethod& method, const AtlasPart& part) {
  const auto call = part.calls.find(method.name);
  const bool is_program = call != part.calls.end();
  return {{"name", valid_utf8(method.name)},
          {"treatment", method.treatment},
          {"call", printable(is_program ? call->second : shell_quoted(method.name))},
          {"program", is_program},
          {"part", method.part}};
}

Json part_json(const AtlasPart& part) {
  return {{"origin", valid_utf8(part.origin)},
          {"options", part.options},
          {"version", part.from.version},
          {"date", part.from.date},
          {"processor", part.from.processor},
          {"compiler", part.from.compiler},
          {"command", valid_utf8(part.from.command)}};
}

Json claim_json(const NamedCells& cells, const std::vector<record::Cell>& row) {
  const auto behaviour = cells.text(row, "claim_behaviour");
  const double order = cells.number(row, "claim_order");
  return {{"text", valid_utf8(cells.text(row, "claim"))},
          {"behaviour", behaviour.empty() ? "undecided" : valid_utf8(behaviour)},
          {"order", std::isfinite(order) ? order : 0.0}};
}

Json ladder_json(const SurveySubject& subject) {
  Json steps = Json::array(), runs = Json::array();
  for (const auto& level : subject.ladder) {
    runs.push_back(level.runs.size());
    for (const auto& run : level.runs) steps.push_back(rounded_number(run.step));
  }
  return {{"by", subject.by_tolerance ? "tolerance" : "step"}, {"runs", runs}, {"steps", steps}};
}

// Fields of a cell that are numbers of its row, and those that are words.
constexpr std::string_view numbers[] = {
    "order",          "order_spread",   "u_error",          "v_error",
    "energy_error",   "rounding_floor", "impacts_expected", "impacts_matched",
    "impacts_missed", "impacts_extra",  "impact_time_error"};
constexpr std::string_view words[] = {"behaviour", "verdict",      "reason",
                                      "diagnosis", "refusal_code", "refusal"};

void add_ladder(Json& cell, const SurveySubject& subject, Shared& ladders) {
  Json errors = Json::array(), steps = Json::array(), forces = Json::array();
  for (const auto& level : subject.ladder) {
    const auto worst = measure::worst(level.runs);
    steps.push_back(worst.work.steps);
    forces.push_back(worst.work.force_evaluations);
    for (const auto& run : level.runs)
      errors.push_back(run.finished ? rounded_number(run.u_error) : nullptr);
  }
  const auto ladder = ladder_json(subject);
  cell.push_back(ladders.place(ladder, json_text(ladder)));
  cell.push_back(errors);
  cell.push_back(steps);
  cell.push_back(forces);
}

}  // namespace

Json survey_data(const Survey& survey, std::span<const AtlasPart> parts) {
  Json data{{"parts", Json::array()},
            {"methods", Json::array()},
            {"systems", Json::array()},
            {"words", nullptr},
            {"claims", nullptr},
            {"ladders", nullptr},
            {"fields", {"method", "system", "claim"}},
            {"cells", Json::array()}};
  for (const auto name : words) data["fields"].push_back(name);
  for (const auto name : numbers) data["fields"].push_back(name);
  for (const auto name : {"ladder", "errors", "steps", "forces"}) data["fields"].push_back(name);
  Shared texts(data["words"]), claims(data["claims"]), ladders(data["ladders"]);
  for (const auto& part : parts) data["parts"].push_back(part_json(part));
  for (const auto& method : survey.methods)
    data["methods"].push_back(method_json(method, parts[method.part]));
  for (const auto& system : survey.systems) data["systems"].push_back(system_json(system));
  std::vector<NamedCells> readers;
  for (const auto& part : parts)
    readers.emplace_back(part.subjects->columns, part.file + ": subjects");
  for (const auto& subject : survey.subjects) {
    const auto& row = parts[subject.part].subjects->rows[subject.row];
    const auto& read = readers[subject.part];
    const auto claim = claim_json(read, row);
    Json cell{subject.method, subject.system, claims.place(claim, json_text(claim))};
    for (const auto name : words) cell.push_back(texts.place(read.text(row, std::string(name))));
    for (const auto name : numbers)
      cell.push_back(rounded_number(read.number(row, std::string(name))));
    add_ladder(cell, subject, ladders);
    data["cells"].push_back(std::move(cell));
  }
  return data;
}

}  // namespace clackers::report
