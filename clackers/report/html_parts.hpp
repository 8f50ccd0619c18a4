#pragma once

#include <string>

#include "clackers/study/baseline.hpp"
#include "clackers/study/record.hpp"

namespace clackers::report {

// The pieces of the page that are plain html; everything of a record in them is escaped.

std::string overall_html(const study::Record& record);   ///< the verdict on the record, notices
std::string verdicts_html(const study::Record& record);  ///< the table and the remarks below it
/// What changed since a baseline: the content of a section.
std::string changes_html(const study::Record& record, const study::BaselineComparison& changes);
std::string figures_html(const study::Record& record);  ///< frames, captions, legends
std::string methods_html(const study::Record& record);  ///< a section a method
/// What one would have concluded without the exact solution, beside what is true.
std::string self_html(const study::MethodResult& method);
/// All metrics of the finest level, collapsed.
std::string metrics_html(const study::MethodResult& method);
/// The first sentences of a page: the case, its length and its collisions.
std::string lead_html(const study::CaseSummary& problem);
std::string case_html(const study::CaseSummary& problem);
std::string again_html(const study::Provenance& provenance);

/// The address of a method's section within the page.
std::string anchor(std::size_t method);
/// A verdict in its badge; the word is text, the colour only repeats it.
std::string badge(const std::string& word);

}  // namespace clackers::report
