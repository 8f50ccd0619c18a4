#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "clackers/base/number.hpp"
#include "clackers/base/text.hpp"
#include "clackers/report/html/figure_data.hpp"
#include "clackers/report/html/figures.hpp"
#include "clackers/report/html/page.hpp"
#include "clackers/report/html/plot_style.hpp"
#include "clackers/report/html/tables.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/words/words.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {
namespace {

using Json = nlohmann::ordered_json;

// "clackers/spectral-radius/1": "spectral-radius".
std::string name_of(const record::Sheet& sheet) {
  const auto first = sheet.schema.find('/') + 1;
  return sheet.schema.substr(first, sheet.schema.rfind('/') - first);
}

std::string cell_html(const record::Cell& cell) {
  if (const auto* real = std::get_if<double>(&cell)) return html_number(*real, 6);
  if (const auto* whole = std::get_if<long long>(&cell)) return html_count(*whole);
  if (const auto* text = std::get_if<std::string>(&cell)) return escape(*text);
  return {};
}

bool is_text(const record::Sheet& sheet) {
  return sheet.columns.size() == 1 && sheet.rows.size() == 1 &&
         std::holds_alternative<std::string>(sheet.rows[0][0]);
}

}  // namespace

std::string sheet_html(const record::Sheet& sheet) {
  if (sheet.rows.empty()) return {};
  if (is_text(sheet))
    return fmt::format("<pre tabindex=\"0\">{}</pre>\n",
                       escape(wrapped(rejoin(std::get<std::string>(sheet.rows[0][0])), 96)));
  std::vector<HtmlColumn> columns;
  for (std::size_t c = 0; c < sheet.columns.size(); ++c) {
    const auto is_number = [&](const auto& row) {
      return row[c].index() == 1 || row[c].index() == 2;
    };
    columns.push_back(
        {sheet.columns[c].name, sheet.columns[c].unit, std::ranges::any_of(sheet.rows, is_number)});
  }
  std::vector<std::vector<std::string>> rows;
  for (const auto& row : sheet.rows) {
    auto& cells = rows.emplace_back();
    for (const auto& cell : row) cells.push_back(cell_html(cell));
  }
  return html_table(sheet.title, {}, columns, rows);
}

namespace {

// A row a point that has a value and is not cut off.
Json points(const record::Sheet& sheet) {
  Json rows = Json::array();
  for (std::size_t c = 1; c < sheet.columns.size(); ++c)
    for (const auto& row : sheet.rows) {
      const auto *x = std::get_if<double>(&row[0]), *y = std::get_if<double>(&row[c]);
      if (x != nullptr && y != nullptr && *y <= sheet.curves->highest)
        rows.push_back(
            {{"series", sheet.columns[c].label()}, {"x", rounded(*x)}, {"y", rounded(*y)}});
    }
  return rows;
}

std::string legend(const record::Sheet& sheet) {
  if (sheet.columns.size() < 3) return {};
  auto out = fmt::format(
      "<div class=\"legend\" role=\"group\" aria-label=\"Curves shown\" data-legend=\"{}\">\n",
      name_of(sheet));
  for (std::size_t c = 1; c < sheet.columns.size(); ++c)
    out += toggle(sheet.columns[c].label(), key_svg(plot_style(c - 1)), sheet.columns[c].label());
  return out + "</div>\n";
}

FigureText figure_of(const record::Sheet& sheet) {
  const auto& axes = *sheet.curves;
  std::string reading;
  if (axes.marks.size() == 1)
    reading += fmt::format("The dashed line is the {}. ", escape(axes.mark_text));
  else if (!axes.marks.empty())
    reading += fmt::format("Dashed lines are {}. ", escape(axes.mark_text));
  if (std::isfinite(axes.highest))
    reading += fmt::format("Values above {} are cut off. ", html_number(axes.highest, 3));
  const auto name = name_of(sheet);
  return {name,
          name,
          escape(sheet.title),
          fmt::format("Against the {}.", escape(sheet.columns[0].label())),
          reading + escape(axes.note),
          legend(sheet)};
}

}  // namespace

std::string html(std::span<const record::Sheet> sheets, const std::string& name,
                 const record::Provenance& from, const record::CaseRecord* motion,
                 const std::string& command, const std::optional<Dials>& dials) {
  Page page;
  page.command = command;
  page.title = "clackers: " + name;
  page.heading = escape(name);
  page.data = page.specifications = Json::object();
  int number = 1;
  if (motion != nullptr) {
    page.heading = escape(case_text(motion->problem, "\u00a0"));
    page.lead = lead_html(*motion);
    if (has_player(*motion)) page.data["motion"] = player_data(*motion);
  }
  if (motion != nullptr && dials) {
    add_dials(page, *dials, number);
  } else if (motion != nullptr) {
    auto data = figure_data(*motion);
    for (const auto* rows : {"response", "impacts"}) page.data[rows] = data[rows];
    page.specifications["response"] = figure_specifications(*motion)["response"];
    page.sections.push_back({"figures", "Figures", "Figures", response_html(*motion, {}, number)});
  }
  for (const auto& sheet : sheets) {
    if (sheet.curves) {
      page.data[name_of(sheet)] = points(sheet);
      page.specifications[name_of(sheet)] = curves_specification(sheet, name_of(sheet));
      auto figures = std::ranges::find(page.sections, "figures", &PageSection::id);
      if (figures == page.sections.end())
        figures = page.sections.insert(figures, {"figures", "Figures", "Figures", {}});
      figures->html += figure_html(number, {}, figure_of(sheet));
    } else {
      const auto section = name_of(sheet);
      auto link = section;
      link[0] = char(std::toupper(static_cast<unsigned char>(link[0])));
      // The head of the page has the summary of the case, which begins the first title.
      const bool is_said = motion != nullptr && sheet.title.starts_with(name + ": ");
      const bool is_sentence = sheet.title.ends_with('.');
      const auto sentence = is_sentence ? fmt::format("<p>{}</p>\n", escape(sheet.title)) : "";
      page.sections.push_back({fmt::format("{}-{}", section, page.sections.size() + 1), link,
                               is_said || is_sentence ? link : sheet.title,
                               sentence + sheet_html(sheet)});
    }
  }
  page.sections.push_back({"again", "Run again", "Run it again", again_html(from)});
  return page_html(page, from);
}

}  // namespace clackers::report
