#include "clackers/report/html/notebook.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "clackers/base/files/json.hpp"
#include "clackers/base/testing/refusal.hpp"
#include "clackers/report/testing/sample_record.hpp"

namespace clackers::report {
namespace {

using Json = nlohmann::ordered_json;

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST(Notebook, ShowsVerdictAndMethodsWithoutScriptsAndLinks) {
  const auto text = notebook_html(sample_record());
  EXPECT_TRUE(has(text, "rk4") && has(text, "badge disagrees"));
  for (const auto* part : {"<script", "<a ", "href", "{{"}) EXPECT_FALSE(has(text, part)) << part;
}

TEST(Notebook, EveryColourOfAFigureAndOfTheTablesIsGiven) {
  const auto record = sample_record();
  const auto text = notebook_html(record);
  for (std::size_t at = text.find("var("); at != std::string::npos;
       at = text.find("var(", at + 1)) {
    const auto variable = text.substr(at + 4, text.find(')', at) - at - 4);
    EXPECT_TRUE(has(text, variable + ": ")) << variable;
  }
  for (const auto& name : figure_names(record.cases[0]))
    EXPECT_FALSE(has(notebook_figure(record.cases[0], name), "var(")) << name;
}

TEST(Notebook, NoTextOfTheRecordBecomesMarkup) {
  auto record = sample_record();
  for (auto& subject : record.cases[0].subjects) subject.name = "<script>" + subject.name;
  EXPECT_FALSE(has(notebook_html(record), "<script"));
}

TEST(NotebookFigure, HoldsTheDataThatItDrawsAndNoMore) {
  const auto record = sample_record();
  const auto figure = parse_json(notebook_figure(record.cases[0], "convergence"));
  std::vector<std::string> names;
  for (const auto& [name, rows] : figure.at("datasets").items()) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"slopes", "runs", "levels"}));
  const auto& runs = figure["datasets"]["runs"];
  EXPECT_EQ(runs[0].at("method"), record.cases[0].subjects[0].name);
  EXPECT_EQ(runs[0].at("u_error"), record.cases[0].subjects[0].levels[0].runs[0].score.u_error);
  EXPECT_FALSE(figure.contains("usermeta"));
  EXPECT_TRUE(figure.at("width").is_number());
}

TEST(NotebookFigure, AnUnknownOneIsRefused) {
  EXPECT_REFUSED(notebook_figure(sample_record().cases[0], "convergense"), "unknown-name",
                 "convergence");
}

}  // namespace
}  // namespace clackers::report
