#include <fmt/format.h>

#include "clackers/report/digest.hpp"
#include "clackers/report/figure_data.hpp"
#include "clackers/report/html_page.hpp"
#include "clackers/report/html_parts.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {

std::string html(const study::Record& record, const study::BaselineComparison* changes) {
  const auto& problem = record.problem;
  Page page{
      .command = "verify",
      .title = "clackers: " + closing(record).word + ", " + case_text(problem),
      .heading = escape(case_text(problem, "\u00a0")),
      .lead = fmt::format("{} {}.", lead_html(problem), escape(ladder_text(record))),
      .overall = overall_html(record),
      .sections = {{"verdicts", "Verdicts", "Verdicts", verdicts_html(record)}},
      .data = figure_data(record),
      .specifications = figure_specifications(record),
  };
  if (changes != nullptr)
    page.sections.push_back({"changes", "Changes", "Changes", changes_html(record, *changes)});
  page.sections.push_back(figures_section(figures_html(record)));
  page.sections.push_back({"methods", "Methods", "Methods", methods_html(record)});
  page.sections.push_back({"case", "Case", "The case", case_html(problem)});
  page.sections.push_back({"again", "Run again", "Run it again", again_html(record.provenance)});
  return page_html(page, record.provenance);
}

}  // namespace clackers::report
