#include "clackers/report/html/page.hpp"

#include <fmt/format.h>

#include "clackers/report/markup.hpp"

namespace clackers::report {
namespace {

std::vector<std::string_view> shared_scripts() {
  return {assets::theme_js,          assets::vega_min_js, assets::vega_lite_min_js,
          assets::vega_embed_min_js, assets::figures_js,  assets::tools_js};
}

}  // namespace

std::string page_html(const Page& page, const record::Provenance& from) {
  std::string links, sections, scripts, hashes;
  for (const auto script : page.scripts) scripts += fmt::format("<script>{}</script>\n", script);
  for (const auto& list : {shared_scripts(), page.scripts})
    for (const auto script : list) hashes += fmt::format(" {}", assets::hash_of(script));
  for (const auto& section : page.sections) {
    links += fmt::format("      <a href=\"#{}\">{}</a>\n", section.id, escape(section.link));
    sections +=
        fill(assets::section_html,
             {{"id", section.id}, {"title", escape(section.title)}, {"content", section.html}});
  }
  return fill(assets::page_html, {{"title", escape(page.title)},
                                  {"script_hashes", hashes.substr(1)},
                                  {"first", page.sections.front().id},
                                  {"first_name", escape(page.sections.front().title)},
                                  {"command", escape(page.command)},
                                  {"links", links},
                                  {"heading", page.heading},
                                  {"lead", page.lead},
                                  {"overall", page.overall},
                                  {"sections", sections},
                                  {"version", escape(from.version)},
                                  {"date", escape(from.date)},
                                  {"style", std::string(assets::page_css) + page.style},
                                  {"theme", std::string(assets::theme_js)},
                                  {"licences", escape(assets::licences)},
                                  {"data", script_json(page.data)},
                                  {"specifications", script_json(page.specifications)},
                                  {"vega", std::string(assets::vega_min_js)},
                                  {"vega_lite", std::string(assets::vega_lite_min_js)},
                                  {"vega_embed", std::string(assets::vega_embed_min_js)},
                                  {"figures_script", std::string(assets::figures_js)},
                                  {"tools_script", std::string(assets::tools_js)},
                                  {"scripts", scripts}});
}

}  // namespace clackers::report
