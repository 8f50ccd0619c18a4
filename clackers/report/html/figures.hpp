#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/record/record.hpp"
#include "clackers/record/sheet.hpp"
#include "clackers/report/html/tables.hpp"

namespace clackers::report {

/// The words around a drawn figure, html. `rows` is the data set that its button CSV saves.
struct FigureText {
  std::string name, rows, title, caption, reading;
  std::string choices{};  ///< buttons of its own, before the tools
};

/// A figure in its frame.
std::string figure_html(int& number, const Place& place, const FigureText& text);

/// A button of a legend that shows or hides a series; `key` is html.
std::string toggle(const std::string& series, const std::string& key, const std::string& text);

/// The figure "response" and, of a case whose structure has a drawing, the player of its motion.
std::string response_html(const record::CaseRecord& problem, const Place& place, int& number);

/// The figures of a case: frames with captions, legends and tools. `number` counts the figures of the
/// page and is raised.
std::string figures_html(const record::CaseRecord& problem, const Place& place, int& number);

/// The figure "profile" of profiles over several cases, with its legend.
std::string profile_html(const record::Record& record, int& number);

/// A counter of work that a figure may show.
struct ShownCounter {
  judge::Counter counter;
  std::string_view field;  ///< name of its column: "force_evaluations"
  std::string title;       ///< "force evaluations", with the unit where there is one
};

/// The counters of which some finished run of a method has more than none, in the order of their
/// buttons.
std::vector<ShownCounter> counters_of(const record::CaseRecord& problem);
/// Those of the profiles.
std::vector<ShownCounter> counters_of(const std::vector<record::Profile>& profiles);

/// What is shown first: force evaluations where they are counted. Throws std::logic_error for none.
ShownCounter first_shown(const std::vector<ShownCounter>& counters);

/// Buttons that choose the counter of a figure; nothing for one counter.
std::string counter_choice(const std::vector<ShownCounter>& counters, std::string_view figure);

/// The Vega-Lite specifications of a case by the name of the figure: "response", and where there is
/// something to show "convergence", "history", "impacts", "work" and "profile". usermeta.counters are the titles
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
