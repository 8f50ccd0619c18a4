#include "clackers/report/atlas.hpp"

#include <fmt/format.h>

#include "clackers/base/error.hpp"
#include "clackers/report/assets.hpp"
#include "clackers/report/atlas/survey_data.hpp"
#include "clackers/report/html/figures.hpp"
#include "clackers/report/html/page.hpp"
#include "clackers/report/html/plot_style.hpp"
#include "clackers/report/html/tables.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_profiles = 12;  // lines of a figure, as many as can be told apart

// How the lines of profiles look, for the legend that the page makes.
Json styles_json() {
  Json styles = Json::array();
  for (std::size_t i = 0; i < most_profiles; ++i) styles.push_back(key_svg(plot_style(i)));
  return styles;
}

Json specifications() {
  std::vector<std::string> places;
  for (std::size_t i = 0; i < most_profiles; ++i) places.push_back(fmt::format("{}", i + 1));
  return {{"ladder", specification_of(assets::atlas_ladder_vl_json, {})},
          {"map", specification_of(assets::atlas_map_vl_json, {})},
          {"work", specification_of(assets::atlas_work_vl_json, {})},
          {"profile", specification_of(assets::profile_vl_json, places,
                                       {{"titles", Json::object()},
                                        {"counter", "force_evaluations"},
                                        {"x_title", "times the least work"}})}};
}

std::string profile_section() {
  int number = 1;
  return "<p>Which methods reach an error with little work, over all systems at once.</p>\n" +
         figure_html(
             number, {},
             {"profile", "profile", "Performance profile of the methods that the matrix shows",
              "<span id=\"profile-caption\"></span>",
              "A task is a system with an error in u to reach: 0.1, 0.01, ... down to the smallest "
              "that some method reaches. A line shows the share of the tasks that a method solves "
              "with "
              "at most that many times the work of the best method for the task (Dolan and Mor\u00e9 "
              "2002). High on the left is cheap, high on the right is reliable. Filters of the "
              "matrix choose the methods.",
              "<div id=\"profile-counters\" class=\"tools\" role=\"group\" "
              "aria-label=\"What the figure counts\"></div>\n"
              "<div id=\"profile-legend\" class=\"legend\" role=\"group\" "
              "aria-label=\"Methods of the figure\"></div>\n"});
}

std::string part_row(const AtlasPart& part) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                     escape(part.origin.empty() ? "this atlas" : part.origin),
                     escape(part.from.version), escape(part.from.date),
                     escape(part.from.processor));
}

std::string again_section(std::span<const AtlasPart> parts, const AtlasText& text) {
  auto out = again_html(text.from);
  if (parts.size() > 1) {
    out +=
        "<h3>Sources of the results</h3>\n<div class=\"scroll\" "
        "tabindex=\"0\"><table>\n<thead><tr><th "
        "scope=\"col\">origin</th><th scope=\"col\">clackers</th><th scope=\"col\">date</th><th "
        "scope=\"col\">processor</th></tr></thead>\n<tbody>\n";
    for (const auto& part : parts) out += part_row(part);
    out += "</tbody></table></div>\n";
  }
  if (!text.specification.empty())
    out += fmt::format(
        "<details class=\"metrics\"><summary>The specification</summary><pre "
        "tabindex=\"0\">{}</pre></details>\n",
        escape(text.specification));
  return out;
}

}  // namespace

void require_few_cells(long long cells) {
  if (cells > most_cells)
    throw InputError(
        fmt::format("atlas: {} methods times systems are finished; allowed: {} in a page. Run a "
                    "specification with fewer values, or read the rows: clackers campaign export, "
                    "clackers campaign query",
                    cells, most_cells),
        "too-many-rows");
}

std::string atlas_page(std::span<const AtlasPart> parts, const AtlasText& text) {
  long long cells = 0;
  for (const auto& part : parts) cells += std::ssize(part.subjects->rows);
  require_few_cells(cells);
  const auto survey = survey_of(parts);
  Page page;
  page.command = text.command;
  page.title = "clackers: " + text.heading;
  page.heading = escape(text.heading);
  page.lead = escape(text.lead);
  page.data["atlas"] = survey_data(survey, parts);
  page.data["atlas"]["profiles"] = survey_profiles(survey);
  page.data["atlas"]["styles"] = styles_json();
  page.specifications = specifications();
  page.style = assets::atlas_css;
  page.scripts = {assets::atlas_js, assets::atlas_figures_js, assets::atlas_panel_js,
                  assets::atlas_matrix_js};
  page.sections = {{"matrix", "Matrix", "Matrix of verdicts", std::string(assets::atlas_html)},
                   {"profile", "Profile", "Performance profile", profile_section()},
                   {"again", "Run again", "Run it again", again_section(parts, text)}};
  return page_html(page, text.from);
}

}  // namespace clackers::report
