#include "paper/catalogue.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "clackers/base/error.hpp"

namespace clackers::paper {
namespace {

TEST(Catalogue, NamesChooseEachFigureOnceInThePapersOrder) {
  EXPECT_EQ(chosen({}).size(), entries().size());
  const auto some = chosen({"figA3", "fig12", "figA3"});
  ASSERT_EQ(some.size(), 2u);
  EXPECT_EQ(some[0].name, "fig12");
  EXPECT_EQ(some[1].name, "figA3");
}

TEST(Catalogue, MisspelledNameIsRefusedWithTheNearest) {
  try {
    chosen({"figg12"});
    FAIL() << "taken";
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "clackers: no figure \"figg12\". Did you mean \"fig12\"? All names: clackers list figures");
    EXPECT_EQ(error.code().name(), "unknown-name");
  }
}

TEST(Catalogue, FiguresAreListedWithTheirTitles) {
  const auto sheet = list_figures();
  ASSERT_EQ(sheet.rows.size(), entries().size());
  EXPECT_EQ(std::get<std::string>(sheet.rows[11][0]), "fig12");
  EXPECT_EQ(std::get<std::string>(sheet.rows[11][1]),
            "Coincidence with the response without impacts");
}

// The whole of a figure, but the validation, which takes a study and has a test of its own.
class EveryFigure : public testing::TestWithParam<Entry> {};

TEST_P(EveryFigure, IsCompleteAndItsClaimsHold) {
  const auto figure = make(GetParam());
  EXPECT_EQ(figure.name, GetParam().name);
  EXPECT_EQ(figure.title, GetParam().title);
  EXPECT_FALSE(figure.caption.empty());
  ASSERT_FALSE(figure.panels.empty());
  for (const auto& panel : figure.panels) {
    EXPECT_FALSE(panel.series.empty());
    EXPECT_FALSE(panel.x.title.empty());
    for (const auto& series : panel.series) {
      if (series.kind == Series::Kind::rule) continue;
      ASSERT_EQ(series.x.size(), series.y.size()) << series.name;
      ASSERT_FALSE(series.x.empty()) << series.name;
      for (const double y : series.y) ASSERT_TRUE(std::isfinite(y)) << series.name;
    }
  }
  EXPECT_EQ(figure.claims.empty(), figure.name == "fig2");
  // What is wrong in the paper.
  const std::set<std::string> wrong{"T_S", "eq15-origin", "eqA12", "eqA16"};
  for (const auto& claim : figure.claims) {
    EXPECT_EQ(claim.verdict == Verdict::does_not_hold, wrong.contains(claim.name))
        << claim.says << "\n"
        << claim.measured;
    EXPECT_EQ(claim.measured.find_first_of("0123456789") == std::string::npos,
              claim.verdict == Verdict::not_measurable)
        << claim.name;
    EXPECT_EQ(claim.condition.empty(),
              claim.verdict == Verdict::holds || claim.verdict == Verdict::does_not_hold)
        << claim.name;
  }
}

TEST_P(EveryFigure, PanelsHaveDifferentNamesAndLettersInOrder) {
  std::set<std::pair<std::string, std::string>> seen;
  char next = 'a';
  for (const auto& panel : GetParam().build(nullptr).panels) {
    EXPECT_TRUE(seen.emplace(panel.label + panel.note, panel.y.title).second) << panel.note;
    if (panel.label.empty()) continue;
    EXPECT_EQ(panel.label, std::string(1, next++));
  }
}

INSTANTIATE_TEST_SUITE_P(Paper, EveryFigure,
                         testing::ValuesIn(entries().begin(), entries().end() - 1),
                         [](const auto& entry) { return std::string(entry.param.name); });

}  // namespace
}  // namespace clackers::paper
