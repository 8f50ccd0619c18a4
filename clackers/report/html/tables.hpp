#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/report/columns.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {

/// A column of an html table: the name, and below it the unit or the like. All text.
struct HtmlColumn {
  std::string heading, detail;
  bool is_number = false;
};

/// A table as html; the first cell of a row is its heading. `label` and `caption` are text, cells are
/// html. `style` is a class of page.css.
std::string html_table(std::string_view label, std::string_view caption,
                       std::span<const HtmlColumn> columns,
                       const std::vector<std::vector<std::string>>& rows,
                       std::string_view style = {});

/// The same of a table of the record. `name_of` makes html of the name that heads a row.
std::string html_table(std::string_view label, std::string_view caption, const Table& table,
                       const std::function<std::string(const Row&)>& name_of,
                       std::string_view style = {});

/// A sheet as a table; a single cell of text as it is.
std::string sheet_html(const record::Sheet& sheet);

/// Where in a page a case or a subject stands.
struct Place {
  std::string suffix;  ///< behind ids and names of figures: "-2" of the second of several cases
  bool has_sections = true;  ///< of subjects, which names are links to
};
/// The id of a subject's section.
std::string anchor(const Place& place, std::size_t subject);
/// A verdict in its badge; the word is text, the colour only repeats it.
std::string badge(std::string_view word);
/// A term and what it is, html; nothing for an empty one.
std::string fact(std::string_view term, const std::string& html);

/// A finding with its code.
std::string finding_html(const Finding& found);

/// The causes of every subject; empty without any.
std::string diagnoses_html(const record::CaseRecord& problem, const Place& place);
/// The tables of methods and of histories of a case, each with its findings and notes.
std::string verdicts_html(const record::CaseRecord& problem, const Place& place);
/// A row a case: how many subjects got which verdict.
std::string cases_html(const record::Record& record);
/// What changed since a baseline.
std::string changes_html(const study::BaselineComparison& changes);
/// Parameters and derived constants.
std::string case_html(const record::CaseSummary& problem);
std::string again_html(const record::Provenance& provenance);

}  // namespace clackers::report
