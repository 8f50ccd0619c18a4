#include "clackers/report/html/notebook.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "clackers/base/check.hpp"
#include "clackers/base/files/json.hpp"
#include "clackers/report/assets.hpp"
#include "clackers/report/html/figure_data.hpp"
#include "clackers/report/html/figures.hpp"
#include "clackers/report/html/page.hpp"
#include "clackers/report/html/tables.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr int figure_width = 620;  // pixels

// A part of page/notebook.json: "colors" or "config".
const Json& look(const char* part) {
  static const Json all = parse_json(assets::notebook_json);
  return all.at(part);
}

// Variables of page.css become colours.
void put_colors(Json& json) {
  if (json.is_structured())
    for (auto& item : json) put_colors(item);
  if (!json.is_string()) return;
  const auto text = json.get<std::string>();
  if (text.starts_with("var(--") && text.ends_with(")"))
    json = look("colors").at(text.substr(6, text.size() - 7));
}

// Names of the data sets that a specification draws.
void add_data_names(const Json& json, std::vector<std::string>& names) {
  if (!json.is_structured()) return;
  if (json.is_object() && json.contains("data")) names.push_back(json["data"].at("name"));
  for (const auto& item : json) add_data_names(item, names);
}

// Rows as Vega-Lite reads them.
Json rows_of(const Json& data) {
  if (data.is_array()) return data;
  Json rows = Json::array();
  for (const auto& cells : data.at("rows")) {
    auto& row = rows.emplace_back(Json::object());
    for (std::size_t i = 0; i < cells.size(); ++i)
      row[data.at("columns")[i].get<std::string>()] = cells[i];
  }
  return rows;
}

}  // namespace

std::string notebook_html(const record::Record& record) {
  std::string colors;
  for (const auto& [name, color] : look("colors").items())
    colors += fmt::format("{}--{}: {}", colors.empty() ? "" : "; ", name, color.get<std::string>());
  auto content = overall_html(record);
  for (std::size_t i = 0; i < record.cases.size(); ++i) {
    const auto& problem = record.cases[i];
    const Place place{record.cases.size() == 1 ? "" : fmt::format("-{}", i + 1), false};
    content += fmt::format("<p><strong>{}</strong><br>{}</p>\n", escape(case_text(problem.problem)),
                           lead_html(problem)) +
               verdicts_html(problem, place);
  }
  return fill(assets::notebook_html, {{"colors", colors}, {"content", content}});
}

std::vector<std::string> figure_names(const record::CaseRecord& problem) {
  std::vector<std::string> names;
  const auto specifications = figure_specifications(problem);
  for (const auto& [name, specification] : specifications.items()) names.push_back(name);
  return names;
}

std::string notebook_figure(const record::CaseRecord& problem, std::string_view name) {
  const auto specifications = figure_specifications(problem);
  if (!specifications.contains(name)) {
    const auto names = figure_names(problem);
    refuse_name("figure", std::string(name), names, fmt::format("{}", fmt::join(names, ", ")));
  }
  auto figure = specifications[std::string(name)];
  figure.erase("usermeta");
  figure["width"] = figure_width;
  figure["config"] = look("config");
  put_colors(figure);
  std::vector<std::string> used;
  add_data_names(figure, used);
  const auto data = figure_data(problem);
  for (const auto& rows : used) figure["datasets"][rows] = rows_of(data.at(rows));
  return json_text(figure);
}

}  // namespace clackers::report
