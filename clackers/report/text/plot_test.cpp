#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/testing/sample_record.hpp"
#include "clackers/report/text/plot.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {
namespace {

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

// The character at a place of a line of UTF-8.
std::string at(const std::string& line, std::size_t place) {
  std::size_t i = 0;
  const auto next = [&] {
    do ++i;
    while (i < line.size() && (static_cast<unsigned char>(line[i]) & 0xC0u) == 0x80u);
  };
  for (std::size_t k = 0; k < place && i < line.size(); ++k) next();
  const auto from = i;
  if (i < line.size()) next();
  return line.substr(from, i - from);
}

TEST(Plot, FitsItsWidthInAboutTwentyLines) {
  const auto record = sample_record().cases[0];
  for (const int width : {40, 80, 132}) {
    const auto out =
        lines(plot(record.response, record.problem.impact_times, {.color = false, .width = width}));
    EXPECT_LE(out.size(), 20u);
    for (const auto& line : out) EXPECT_LE(display_width(line), std::size_t(width)) << line;
  }
}

TEST(Plot, PutsHighAboveLowAndEarlyBeforeLate) {
  // A straight line from (0, -1) to (1, 1): dots in the lower left and upper right corner only.
  const record::Curve curve{{0.0, 1.0}, {{-1.0, 1.0}}};
  const auto out = lines(plot(curve, {}));
  EXPECT_EQ(at(out[15], 10), "⣀") << out[15];
  EXPECT_EQ(display_width(out[1]), 80u);   // reaches the right edge
  EXPECT_LT(display_width(out[15]), 20u);  // nothing to the right at the bottom
  EXPECT_NE(out[1].find("1 m ┤"), std::string::npos);
  EXPECT_NE(out[8].find(" 0 m ┤"), std::string::npos);
  EXPECT_NE(out[15].find("-1 m ┤"), std::string::npos);
  EXPECT_TRUE(out.back().ends_with("1 s"));
}

TEST(Plot, DrawsASteepFallAsOneColumnOfDots) {
  const auto out = lines(plot({{0.0, 1e-9, 1.0}, {{1.0, -1.0, -1.0}}}, {}));
  for (std::size_t row = 1; row <= 14; ++row) EXPECT_EQ(at(out[row], 10), "⡇") << row;
  EXPECT_EQ(at(out[15], 10), "⣇");
}

TEST(Plot, MarksImpactsOnTheAxis) {
  const auto record = sample_record().cases[0];
  const auto text = plot(record.response, record.problem.impact_times);
  const auto axis = lines(text)[16];
  std::size_t marks = 0, from = 0;
  while ((from = axis.find("▲", from)) != std::string::npos) ++marks, ++from;
  EXPECT_EQ(marks, 6u);
  // pi/2 of 20 s over 70 columns, the first of which is at place 10.
  EXPECT_EQ(at(axis, 10 + 5), "▲");
  EXPECT_EQ(at(axis, 10 + 60), "▲");  // 5.5 pi
  EXPECT_EQ(plot(record.response, {}).find("▲"), std::string::npos);
}

TEST(Plot, TellsTheMassesApartWithoutColour) {
  const auto text = plot(sample_record().cases[0].response, {});
  const auto body = text.substr(text.find('\n'));
  EXPECT_GE(std::ranges::count(body.substr(0, body.find("└")), '1'), 3);
  EXPECT_NE(body.find('2'), std::string::npos);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  const auto colored = plot(sample_record().cases[0].response, {}, {.color = true});
  EXPECT_NE(colored.find("\x1b[34m"), std::string::npos);
  EXPECT_NE(colored.find("\x1b[33m"), std::string::npos);
}

record::Curve rising_curves(std::size_t masses) {
  record::Curve curve{{0.0, 1.0}, {}};
  for (std::size_t i = 1; i <= masses; ++i) curve.y.push_back({0.0, double(i)});
  return curve;
}

TEST(Plot, NumbersUpToNineMassesAndSaysHowManyThereAre) {
  EXPECT_EQ(lines(plot(rising_curves(5), {}))[0],
            std::string(10, ' ') + "u [m] against t [s]; 1: mass 1, ..., 5: mass 5");
  const auto out = lines(plot(rising_curves(14), {}));
  EXPECT_EQ(out[0], std::string(10, ' ') + "u [m] against t [s]; 1: mass 1, ..., 9: mass 9 of 14");
  EXPECT_NE(out[1].find("9 m ┤"), std::string::npos);  // the tenth mass is not drawn
}

TEST(Plot, DrawsAMotionAtRestInTheMiddle) {
  const auto out = lines(plot({{0.0, 1.0}, {{0.25, 0.25}}}, {}));
  EXPECT_NE(out[8].find("0.25 m ┤"), std::string::npos);
  EXPECT_EQ(display_width(out[8]), 80u);
}

record::Sheet decay(record::Axes axes) {
  return {"clackers/decay/1",
          "Decay",
          {{"h/T", "", ""}, {"slow", "", ""}, {"fast", "", ""}},
          {{0.01, 1.0, 10.0}, {1.0, 10.0, {}}, {100.0, 100.0, 1e4}},
          axes};
}

TEST(CurvesPlot, HasTheNamesOfTheCurvesAndLogarithmicAxes) {
  const auto out = lines(curves(decay({.log_x = true, .log_y = true}), {}));
  EXPECT_NE(out[0].find("Decay; across: h/T; 1: slow, 2: fast"), std::string::npos);
  EXPECT_NE(out[1].find("1e4 ┤"), std::string::npos);  // the point of the second curve alone
  EXPECT_NE(out[5].find("100 ┤"), std::string::npos);
  EXPECT_NE(out[9].find("1 ┤⣀"), std::string::npos);
  EXPECT_NE(out[11].find("0.01"), std::string::npos);
  EXPECT_TRUE(out[11].ends_with("100"));
}

TEST(CurvesPlot, MarksALimitOnItsAxis) {
  const auto out = lines(curves(decay({.log_x = true, .marks = {1.0}, .mark_text = "limit"}), {}));
  EXPECT_NE(out[0].find("▲ limit"), std::string::npos);
  EXPECT_EQ(display_width(out[10].substr(0, out[10].find("▲"))), 45u);  // the middle
}

TEST(CurvesPlot, CutsOffWhatIsTooHigh) {
  const auto out = lines(curves(decay({.log_x = true, .highest = 50.0}), {}));
  EXPECT_NE(out[1].find("10 ┤"), std::string::npos);
}

TEST(CurvesPlot, LabelsStandOnTheirLinesAndAtPointsThatNoLineReaches) {
  auto sheet = decay({});
  sheet.columns[0].kind = record::ColumnKind::whole;
  sheet.rows = {{1.0, 0.0, {}}, {2.0, 8.0, 4.0}};
  const auto out = lines(curves(sheet, {}));
  EXPECT_EQ(display_width(out[5].substr(0, out[5].find('2'))), 79u) << out[5];
  EXPECT_EQ(out[1].find('1'), std::string::npos) << "its line is low there";
  EXPECT_NE(out[9].find('1'), std::string::npos);
  EXPECT_TRUE(out[11].ends_with("2")) << out[11];
  EXPECT_EQ(out[11].find("1.5"), std::string::npos);
  sheet.rows = {{1.0, {}, {}}, {2.0, 8.0, 8.0}};
  EXPECT_TRUE(lines(curves(sheet, {}))[5].ends_with("21"));
}

TEST(CurvesPlot, DrawsACurveThatOnlyRoundingChangesAsALine) {
  auto sheet = decay({});
  sheet.columns.pop_back();
  sheet.rows = {{0.0, 1.0}, {1.0, 1.0 + 1e-9}, {2.0, 1.0 - 1e-9}};
  const auto out = lines(curves(sheet, {}));
  EXPECT_NE(out[5].find("1 ┤"), std::string::npos);
  EXPECT_EQ(display_width(out[5]), 80u);
}

TEST(Plot, RefusesWhatIsNoCurve) {
  EXPECT_THROW(plot({{0.0}, {{1.0}}}, {}), InputError);
  EXPECT_THROW(plot({{0.0, 1.0}, {}}, {}), InputError);
  EXPECT_THROW(plot({{0.0, 1.0}, {{1.0}}}, {}), InputError);
}

}  // namespace
}  // namespace clackers::report
