#pragma once

#include <string>
#include <vector>

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

}  // namespace clackers::report
