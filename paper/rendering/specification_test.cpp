#include "paper/rendering/page.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "paper/rendering/assets.hpp"

namespace clackers::paper {
namespace {

using Json = nlohmann::ordered_json;

Figure small() {
  Figure figure;
  figure.columns = 2;
  const Axis time{.title = "t [s]", .lowest = 0.0, .highest = 2.0}, length{.title = "u [m]"};
  const Axis error{.title = "e", .lowest = 0.5, .highest = 200.0, .logarithmic = true};
  figure.panels = {
      {"a", "left", time, length, {{"mass 1", {0, 1, 1, 2}, {0, 1, 2, 1.23456789}, first_mass()}}},
      {"b", "", time, length, {{"mass 2", {0, 1}, {1, 2}, second_mass()}}},
      {"c",
       "",
       time,
       error,
       {{"hits", {1}, {3}, {light::m3}, Series::Kind::points},
        {"at", {1}, {}, {light::m4}, Series::Kind::rule},
        {"word", {1}, {2}, {light::ink}, Series::Kind::text}}}};
  return figure;
}

const Json& line_of(const Json& specification, std::size_t panel) {
  return specification.at("concat").at(panel).at("layer").at(0);
}

TEST(Specification, HoldsEveryPanelWithItsHeadingAndData) {
  const auto json = specification(small());
  ASSERT_EQ(json.at("concat").size(), 3u);
  EXPECT_EQ(json.at("columns"), 2);
  EXPECT_EQ(json["concat"][0]["title"], "(a)  left");
  EXPECT_EQ(json["concat"][1]["title"], "(b)");
  const auto& row = line_of(json, 0).at("data").at("values").at(0);
  EXPECT_EQ(row.at("series"), "mass 1");
  EXPECT_EQ(row.at("x"), (Json{0, 1, 1, 2}));
  EXPECT_EQ(row.at("y"), (Json{0, 1, 2, 1.23457}));
}

TEST(Specification, PointsKeepTheirOrderAtAJump) {
  EXPECT_EQ(line_of(specification(small()), 0).at("encoding").at("order").at("value"), nullptr);
}

TEST(Specification, PanelsShareOneLegend) {
  const auto json = specification(small());
  for (const std::size_t panel : {0u, 1u}) {
    const auto& encoding = line_of(json, panel).at("encoding");
    for (const auto* channel : {"stroke", "strokeDash", "strokeWidth"})
      EXPECT_EQ(encoding.at(channel).at("scale").at("domain"), (Json{"mass 1", "mass 2"}));
    EXPECT_EQ(encoding.at("strokeWidth").at("scale").at("range"), (Json{2.0, 0.9}));
    EXPECT_EQ(encoding.at("strokeDash").at("scale").at("range"), (Json{{1, 0}, {1, 0}}));
    EXPECT_FALSE(encoding.at("stroke").at("legend").is_null());
  }
}

TEST(Specification, SingleCurveHasNoLegend) {
  auto figure = small();
  figure.panels = {figure.panels.front()};
  const auto line = line_of(specification(figure), 0);
  EXPECT_FALSE(line["encoding"].contains("stroke"));
  EXPECT_EQ(line["mark"]["stroke"], "#0b62a4");
  EXPECT_EQ(line["mark"]["strokeWidth"], 2.0);
  EXPECT_EQ(line["mark"]["strokeDash"], (Json{1, 0}));
}

TEST(Specification, AxisTitleIsDrawnOnceARowAndColumn) {
  const auto json = specification(small());
  const auto axis = [&](std::size_t panel, const char* name) {
    return line_of(json, panel).at("encoding").at(name).at("axis").at("title");
  };
  EXPECT_EQ(line_of(json, 0)["encoding"]["x"]["scale"]["domain"], (Json{0, 2}));
  EXPECT_FALSE(line_of(json, 0)["encoding"]["y"]["scale"].contains("domain"));
  EXPECT_EQ(line_of(json, 0)["encoding"]["x"]["axis"]["tickCount"], 11);  // 560 px
  EXPECT_EQ(axis(0, "y"), "u [m]");
  EXPECT_EQ(axis(1, "y"), nullptr);
  EXPECT_EQ(axis(0, "x"), nullptr);  // panel c below has it
  EXPECT_EQ(axis(1, "x"), "t [s]");
}

TEST(Specification, PointsRulesAndTextHaveTheirMarks) {
  const auto layers = specification(small()).at("concat").at(2).at("layer");
  ASSERT_EQ(layers.size(), 3u);
  EXPECT_EQ(layers[0]["mark"]["type"], "rule");
  EXPECT_EQ(layers[1]["mark"]["type"], "point");
  EXPECT_EQ(layers[1]["encoding"]["y"]["scale"]["type"], "log");
  EXPECT_EQ(layers[1]["encoding"]["y"]["axis"]["values"], (Json{1, 10, 100}));
  EXPECT_EQ(layers[2]["mark"]["text"], "word");
}

TEST(Specification, LongCurveIsThinnedAndKeepsItsPeaks) {
  auto figure = small();
  figure.panels.resize(1);
  auto& series = figure.panels[0].series[0];
  series.x.clear();
  series.y.clear();
  for (int i = 0; i < 100'000; ++i) {
    series.x.push_back(i * 2e-5);
    series.y.push_back(i == 54'321 ? 7.0 : std::sin(i * 0.01));
  }
  const auto row = line_of(specification(figure), 0).at("data").at("values").at(0);
  EXPECT_LE(row["y"].size(), 3000u);
  EXPECT_NE(std::find(row["y"].begin(), row["y"].end(), Json(7.0)), row["y"].end());
}

TEST(Specification, SubnormalNumbersAreDrawn) {
  auto figure = small();
  figure.panels.resize(1);
  figure.panels[0].series[0].y = {0, 1e-310, 5e-324, -1.23456789e-320};
  const auto row = line_of(specification(figure), 0).at("data").at("values").at(0);
  EXPECT_EQ(row.at("y"), (Json{0, 1e-310, 5e-324, -1.23456e-320}));
}

TEST(Specification, LogarithmicAxisIsLabelledByPowersOfTen) {
  auto figure = small();
  auto& axis = figure.panels[2].y;
  axis.lowest = 1e-12;
  axis.highest = 10.0;
  const auto json = specification(figure)["concat"][2]["layer"][1]["encoding"]["y"]["axis"];
  EXPECT_EQ(json["values"].size(), 7u);  // every second power
  EXPECT_EQ(
      json["labelExpr"],
      "['10⁻¹²','10⁻¹⁰','10⁻⁸','10⁻⁶','10⁻⁴','10⁻²','10⁰'][round((log(datum.value) / LN10 - -12) / 2)]");
}

}  // namespace
}  // namespace clackers::paper
