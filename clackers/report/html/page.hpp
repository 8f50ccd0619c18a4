#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/record/record.hpp"
#include "clackers/report/assets.hpp"
#include "clackers/report/html/tables.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {

/// A section of a page. `link` is its name in the bar above.
struct PageSection {
  std::string id, link, title;  ///< title and link are text
  std::string html;
};

/// A page before it is put together: html where nothing else is said.
struct Page {
  std::string command;  ///< "verify"
  std::string title;    ///< of the window, text
  std::string heading, lead, overall;
  std::vector<PageSection> sections;  ///< the first is what a reader of screens may skip to
  nlohmann::ordered_json data, specifications;  ///< of the figures, by name
  std::string style{};                          ///< beside page.css
  std::vector<std::string_view> scripts{assets::page_js, assets::scene_js, assets::player_js};
};

/// One self-contained page that opens without a network: style, libraries and figures inside. Its
/// content security policy allows the scripts of this library and nothing else.
std::string page_html(const Page& page, const record::Provenance& from);

/// Adds sections whose dials move the exact motion of a pair and runs of methods; `number` counts figures.
void add_dials(Page& page, const Dials& dials, int& number);

/// A section for each subject of a case: finding, facts, levels, what one would conclude without the
/// exact solution, and metrics.
std::string subjects_html(const record::CaseRecord& problem, const Place& place);

// What stands above the sections of a record.

/// What the case is, how long, and its steps.
std::string lead_html(const record::CaseRecord& problem);

/// The verdict over all, and what it rests on.
std::string overall_html(const record::Record& record);

}  // namespace clackers::report
