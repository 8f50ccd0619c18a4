#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clackers/record/record.hpp"

// A record in a notebook, whose page may be light or dark: colours of middle lightness, no scripts.
namespace clackers::report {

/// Verdict, causes and tables of all cases as a piece of html with its own style.
std::string notebook_html(const record::Record& record);

/// The figures that there is something to draw of: "response", "convergence", ...
std::vector<std::string> figure_names(const record::CaseRecord& problem);

/// A figure as a Vega-Lite specification, version 5, with its data, colours and legend inside: json.
/// Throws InputError with did-you-mean for a name that figure_names() does not have.
std::string notebook_figure(const record::CaseRecord& problem, std::string_view name);

}  // namespace clackers::report
