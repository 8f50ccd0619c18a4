#include "paper/catalogue.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace clackers::paper {
namespace {

TEST(Csv, NumbersReadBackUnderPanelAndSeries) {
  Figure figure;
  figure.panels = {{"a",
                    "N = 1",
                    {.title = "t [s]"},
                    {.title = "u, \"v\""},
                    {{"mass 1", {0.1, 1.0 / 3.0}, {1e-17, -2.0}, first_mass()},
                     {"at", {0.5}, {}, first_mass(), Series::Kind::rule},
                     {"word", {0}, {0}, first_mass(), Series::Kind::text}}}};
  std::ostringstream out;
  write_csv(figure, out);
  EXPECT_EQ(out.str(),
            "panel,series,x_name,x,y_name,y\n"
            "a,mass 1,t [s],0.1,\"u, \"\"v\"\"\",1e-17\n"
            "a,mass 1,t [s],0.3333333333333333,\"u, \"\"v\"\"\",-2\n"
            "a,at,t [s],0.5,\"u, \"\"v\"\"\",\n");
}

TEST(Csv, PanelsOfOneLetterDifferByTheirNote) {
  Figure figure;
  figure.columns = 2;
  const Panel panel{"a", "N = 1", {.title = "x"}, {.title = "y"}, {{"m", {1}, {2}, first_mass()}}};
  figure.panels = {panel, panel};
  figure.panels[1].label = "";
  std::ostringstream out;
  write_csv(figure, out);
  EXPECT_EQ(out.str(), "panel,series,x_name,x,y_name,y\na N = 1,m,x,1,y,2\nN = 1,m,x,1,y,2\n");
}

TEST(Claims, EachIsARowWithItsVerdict) {
  Figure figure;
  figure.name = "fig0";
  figure.claims = {{"a", 0, "2.1", "says", Verdict::holds, "found 1", ""},
                   {"b", 1, "2.2", "says more", Verdict::does_not_hold, "found 2", ""},
                   {"c", 2, "3", "third", Verdict::holds_where, "3", "x > 0"},
                   {"d", 3, "3", "fourth", Verdict::not_measurable, "", "nobody knows"}};
  const auto sheet = claims_of({figure, figure});
  ASSERT_EQ(sheet.rows.size(), 8u);
  const std::vector<record::Cell> first{"a", "2.1", "fig0", "holds", "says", "", "found 1"};
  EXPECT_EQ(sheet.rows[0], first);
  EXPECT_EQ(sheet.rows[5][3], record::Cell("does not hold"));
  const auto short_sheet = claims_of({figure}, true);
  ASSERT_EQ(short_sheet.columns.size(), 4u);
  const std::vector<record::Cell> third{"c", "holds where", "third", "Where x > 0. 3"},
      fourth{"d", "not measurable", "fourth", "Because nobody knows."};
  EXPECT_EQ(short_sheet.rows[2], third);
  EXPECT_EQ(short_sheet.rows[3], fourth);
}

}  // namespace
}  // namespace clackers::paper
