// Problems, specifications of campaigns, and results of others through to the page that shows them.
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "clackers/base/files/json.hpp"
#include "clackers/base/number.hpp"
#include "clackers/campaign/atlas.hpp"
#include "clackers/model/problem_file.hpp"
#include "clackers/report/atlas/survey_data.hpp"
#include "target.hpp"

namespace clackers::fuzz {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts{text.substr(0, text.find(separator))};
  while (parts.back().end() != text.end()) {
    const auto rest = text.substr(std::size_t(parts.back().end() - text.begin()) + 1);
    parts.push_back(rest.substr(0, rest.find(separator)));
  }
  return parts;
}

// As SQLite gives a cell: nothing, a whole number, a number, or text.
record::Cell cell_of(std::string_view text) {
  if (text.empty()) return {};
  if (const auto whole = whole_number(text)) return *whole;
  double value = 0.0;
  const auto error = read_number(text, value);
  if ((error == NumberError::none || error == NumberError::not_finite) && !std::isnan(value))
    return value;
  return std::string(text);
}

// A header of names, then rows, with commas.
record::Sheet sheet_of(std::string_view text) {
  record::Sheet sheet;
  for (const auto line : split(text, '\n')) {
    const auto cells = split(line, ',');
    if (sheet.columns.empty()) {
      for (const auto name : cells) sheet.columns.push_back({std::string(name), "", ""});
      continue;
    }
    auto& row = sheet.rows.emplace_back();
    for (std::size_t c = 0; c < sheet.columns.size(); ++c)
      row.push_back(c < cells.size() ? cell_of(cells[c]) : record::Cell());
  }
  return sheet;
}

}  // namespace

// Of TOML, JSON or lines.
void read_problem(std::string_view bytes) {
  const auto problem = model::problem_from_text(bytes, "problem");
  for (auto* write : {model::problem_json, model::problem_file_text}) {
    const auto text = write(problem);
    require(write(model::problem_from_text(text, "again")) == text, "a problem survives its text");
  }
}

void read_campaign(std::string_view bytes) {
  using campaign::Specification;
  const auto specification = Specification::from_toml(bytes, "campaign");
  const auto systems = specification.systems();
  require(systems > 0 && specification.tasks() >= systems, "a campaign has tasks");
  const auto settings = [](const Specification& of, long long number) {
    std::map<std::string, ParameterValue> values;
    for (const auto& [name, value] : of.system(number).settings) {
      require(value.is_word() || std::isfinite(double(value)), "settings are finite");
      values.emplace(name, value);
    }
    return values;
  };
  const campaign::MethodEntry entry{
      campaign::MethodEntry::Kind::command, "'a' \"b\" {h}", "ours", {}};
  const auto text = campaign::with_methods(specification.text(), {&entry, 1});
  const auto other = Specification::from_toml(text, "other");
  require(other.systems() == systems && other.tasks() == systems,
          "systems stay, one method is left");
  require(other.methods().front().text == entry.text, "a command survives its text");
  for (const auto number : {0LL, systems / 2, systems - 1})
    require(settings(specification, number) == settings(other, number), "systems are the same");
}

// Subjects, a line "---", runs. The frame of the page is the same for all, and made of few.
void show_results(std::string_view bytes) {
  constexpr std::string_view between = "\n---\n";
  const auto at = std::min(bytes.find(between), bytes.size());
  const auto subjects = sheet_of(bytes.substr(0, at));
  const auto runs = sheet_of(bytes.substr(std::min(at + between.size(), bytes.size())));
  record::SheetRows first(runs), second(runs);
  report::AtlasPart part;
  part.subjects = &subjects;
  part.runs = &first;
  part.calls["ours"] = "--exec './ours {h}'";
  const auto survey = report::survey_of({&part, 1});
  require(!json_text(report::survey_data(survey, {&part, 1})).empty(), "a page has its data");
  require(!json_text(report::survey_profiles(survey)).empty(), "a page has its profiles");
  if (!every_output && bytes.size() % 16 != 0) return;
  part.runs = &second;
  require(report::atlas_page({&part, 1}, {}).ends_with("</html>\n"), "a page is complete");
}

}  // namespace clackers::fuzz
