#include <fmt/format.h>

#include "clackers/report/html/figure_data.hpp"
#include "clackers/report/html/figures.hpp"
#include "clackers/report/html/page.hpp"
#include "clackers/report/html/tables.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/words/words.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {
namespace {

constexpr auto noscript =
    "<noscript><p class=\"notice\">The figures are drawn by JavaScript, which is switched off. "
    "All numbers are in the tables.</p></noscript>\n  ";

std::vector<PageSection> case_sections(const record::CaseRecord& problem, const Place& place,
                                       int& number) {
  const auto id = [&](const char* name) { return name + place.suffix; };
  return {{id("verdicts"), "Verdicts", "Verdicts", verdicts_html(problem, place)},
          {id("figures"), "Figures", "Figures", noscript + figures_html(problem, place, number)},
          {id("methods"), "Methods", problem.plan.levels > 0 ? "Methods" : "Histories",
           subjects_html(problem, place)},
          {id("case"), "Case", "The case", case_html(problem.problem)}};
}

// The sections of one case as one.
PageSection case_section(const record::CaseRecord& problem, std::size_t index, int& number) {
  const Place place{fmt::format("-{}", index + 1)};
  auto html = fmt::format("<p>{}</p>\n", lead_html(problem));
  for (const auto& section : case_sections(problem, place, number))
    html +=
        fmt::format("<div id=\"{}\">\n<h3>{}</h3>\n{}</div>\n",
                    section.id == "case" + place.suffix ? "parameters" + place.suffix : section.id,
                    escape(section.title), section.html);
  return {"case" + place.suffix, problem.problem.name, case_text(problem.problem), std::move(html)};
}

void add_figures(Page& page, const record::CaseRecord& problem, const Place& place) {
  const auto data = figure_data(problem);
  for (const auto& [name, rows] : data.items()) page.data[name + place.suffix] = rows;
  if (has_player(problem)) page.data["motion" + place.suffix] = player_data(problem);
  auto specifications = figure_specifications(problem);
  for (auto& [name, specification] : specifications.items()) {
    if (!place.suffix.empty()) rename_data(specification, place.suffix);
    page.specifications[name + place.suffix] = specification;
  }
}

void add_one_case(Page& page, const record::CaseRecord& problem, int& number) {
  page.heading = escape(case_text(problem.problem, "\u00a0"));
  page.lead = lead_html(problem);
  add_figures(page, problem, {});
  page.sections = case_sections(problem, {}, number);
}

void add_several_cases(Page& page, const record::Record& record, int& number) {
  page.heading = escape(counted(std::ssize(record.cases), "case"));
  page.sections.push_back(
      {"cases", "Cases", "Cases", cases_html(record) + profile_html(record, number)});
  if (!record.profiles.empty()) {
    page.data["profile"] = profile_data(record.profiles, record.cases);
    page.specifications["profile"] = profile_specification(record.profiles);
  }
  for (std::size_t i = 0; i < record.cases.size(); ++i) {
    add_figures(page, record.cases[i], {fmt::format("-{}", i + 1)});
    page.sections.push_back(case_section(record.cases[i], i, number));
  }
}

}  // namespace

std::string html(const record::Record& record, const study::BaselineComparison* changes) {
  Page page;
  page.command = record.command;
  int number = 1;
  if (record.cases.size() == 1)
    add_one_case(page, record.cases.front(), number);
  else
    add_several_cases(page, record, number);
  const auto what = record.cases.size() == 1 ? case_text(record.cases.front().problem)
                                             : counted(std::ssize(record.cases), "case");
  page.title = fmt::format("clackers: {}, {}", verdict_line(record).word, what);
  page.overall = overall_html(record);
  if (changes != nullptr)
    page.sections.insert(page.sections.begin() + 1,
                         {"changes", "Changes", "Changes", changes_html(*changes)});
  page.sections.push_back({"again", "Run again", "Run it again", again_html(record.provenance)});
  return page_html(page, record.provenance);
}

}  // namespace clackers::report
