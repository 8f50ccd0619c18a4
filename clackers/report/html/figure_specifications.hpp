#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/record/record.hpp"
#include "clackers/record/sheet.hpp"

namespace clackers::report {

/// The Vega-Lite specifications of a case by the name of the figure: "response", and where there is
/// something to show "convergence", "history", "work" and "profile". usermeta.counters are the titles
/// of a figure's counters. Each names its data sets; colours are variables of page.css.
nlohmann::ordered_json figure_specifications(const record::CaseRecord& problem);

/// An embedded specification with its "$placeholders" replaced: those of the methods, which a figure
/// tells apart by colour, marker and dash, those of axes, and `values`.
nlohmann::ordered_json specification_of(
    std::string_view text, const std::vector<std::string>& methods,
    nlohmann::ordered_json values = nlohmann::ordered_json::object());

/// That of profiles over several cases, which name the methods.
nlohmann::ordered_json profile_specification(const std::vector<record::Profile>& profiles);

/// That of a sheet of curves, whose data set is `name`.
nlohmann::ordered_json curves_specification(const record::Sheet& sheet, std::string_view name);

/// Appends `suffix` to the names of the data sets, so that the figures of several cases can stand in
/// one page.
void rename_data(nlohmann::ordered_json& specification, std::string_view suffix);

}  // namespace clackers::report
