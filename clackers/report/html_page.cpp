#include "clackers/report/html_page.hpp"

#include <fmt/format.h>

#include <cctype>

#include "clackers/report/assets.hpp"
#include "clackers/report/markup.hpp"

namespace clackers::report {
namespace {

std::string links_of(const std::vector<PageSection>& sections) {
  std::string out;
  for (const auto& section : sections)
    out += fmt::format("      <a href=\"#{}\">{}</a>\n", section.id, escape(section.link));
  return out;
}

std::string section_of(const PageSection& section) {
  return fmt::format(
      "<section id=\"{0}\" aria-labelledby=\"{0}-title\">\n  <h2 id=\"{0}-title\">{1}</h2>\n  "
      "{2}\n</section>\n",
      section.id, escape(section.title), section.html);
}

std::string sections_of(const std::vector<PageSection>& sections) {
  std::string out;
  for (const auto& section : sections) out += section_of(section);
  return out;
}

}  // namespace

std::string page_html(const Page& page, const study::Provenance& from) {
  auto first_name = page.sections.front().title;
  first_name[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(first_name[0])));
  return fill(assets::page_html, {{"title", escape(page.title)},
                                  {"first", page.sections.front().id},
                                  {"first_name", escape(first_name)},
                                  {"command", escape(page.command)},
                                  {"links", links_of(page.sections)},
                                  {"heading", page.heading},
                                  {"lead", page.lead},
                                  {"overall", page.overall},
                                  {"sections", sections_of(page.sections)},
                                  {"version", escape(from.version)},
                                  {"date", escape(from.date)},
                                  {"style", std::string(assets::page_css)},
                                  {"licences", escape(assets::licences)},
                                  {"data", script_json(page.data)},
                                  {"specifications", script_json(page.specifications)},
                                  {"vega", std::string(assets::vega_min_js)},
                                  {"vega_lite", std::string(assets::vega_lite_min_js)},
                                  {"vega_embed", std::string(assets::vega_embed_min_js)},
                                  {"figures_script", std::string(assets::figures_js)},
                                  {"page_script", std::string(assets::page_js)}});
}

PageSection figures_section(const std::string& figures) {
  return {
      "figures", "Figures", "Figures",
      "<noscript><p class=\"notice\">The figures are drawn by JavaScript, which is switched off. "
      "All numbers stand in the tables.</p></noscript>\n  " +
          figures};
}

}  // namespace clackers::report
