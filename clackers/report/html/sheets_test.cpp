#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "clackers/base/files/json.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {
namespace {

using Json = nlohmann::ordered_json;

std::vector<record::Sheet> sheets() {
  return {{"clackers/facts/1", "Facts", {{"name", "", ""}, {"value", "m", ""}}, {{"a<b", 0.25}}},
          {"clackers/card/1", "Card", {{"card", "", ""}}, {{"u1 = u0 & v0"}}},
          {"clackers/decay/1",
           "Decay",
           {{"h/T", "", "step"}, {"slow", "", "slow mass, u_s"}, {"fast", "", ""}},
           {{0.1, 1.0, 0.5}, {1.0, 2.0, {}}, {10.0, 4.0, 0.25}},
           record::Axes{
               .log_x = true, .highest = 3.0, .y = "u", .marks = {2.0}, .mark_text = "limit"}}};
}

// What stands in the script element `id` of the page.
Json embedded(const std::string& page, const std::string& id) {
  const auto head = "<script type=\"application/json\" id=\"" + id + "\">";
  const auto from = page.find(head) + head.size();
  return parse_json(page.substr(from, page.find("</script>", from) - from));
}

TEST(SheetsPage, HasTablesTextsAndTheCommand) {
  record::Provenance from;
  from.command = "clackers show newmark";
  const auto page = html(sheets(), "newmark", from);
  for (const auto* part : {"a&lt;b", "0.25", "u1 = u0 &amp; v0", "clackers show newmark"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST(SheetsPage, DrawsThePointsThatHaveAValueAndAreNotCutOff) {
  const auto page = html(sheets(), "newmark", {});
  EXPECT_EQ(
      embedded(page, "data")["decay"],
      parse_json(
          R"([{"series":"slow mass, u_s","x":0.1,"y":1.0},{"series":"slow mass, u_s","x":1.0,"y":2.0},
                            {"series":"fast","x":0.1,"y":0.5},{"series":"fast","x":10.0,"y":0.25}])"));
  const auto drawn = embedded(page, "specifications")["decay"];
  EXPECT_EQ(drawn["data"]["name"], "decay");
  EXPECT_EQ(drawn["encoding"]["x"]["scale"]["type"], "log");
  EXPECT_EQ(drawn["layer"][0]["data"]["values"][0]["x"], 2.0);
  const auto& lines = drawn["layer"][1]["encoding"];
  EXPECT_EQ(lines["y"]["scale"]["type"], "linear");
  EXPECT_EQ(lines["y"]["axis"]["title"], "u");
  EXPECT_EQ(lines["color"]["scale"]["domain"], Json({"slow mass, u_s", "fast"}));
  EXPECT_EQ(json_text(drawn).find("\"$"),
            json_text(drawn).find("\"$schema"));  // no placeholder is left
}

TEST(SheetsPage, PointsAtWholeNumbersAreDrawnAndNamed) {
  std::vector<record::Sheet> all{{"clackers/order/1",
                                  "Order",
                                  {{"record", "", "", record::ColumnKind::whole}, {"rk4", "", ""}},
                                  {{1.0, 2.0}, {2.0, 2.0}},
                                  record::Axes{.x_names = {"v1.0", "v\"2"}, .y = "order"}}};
  const auto drawn = embedded(html(all, "records", {}), "specifications")["order"];
  EXPECT_EQ(drawn["layer"][2]["mark"]["opacity"], 1);
  EXPECT_EQ(drawn["encoding"]["x"]["axis"]["labelExpr"], R"(["v1.0","v\"2"][datum.value - 1])");
  const auto& y = drawn["layer"][1]["encoding"]["y"];
  EXPECT_EQ(y["axis"]["title"], "order, rk4");
  EXPECT_LT(y["scale"]["domain"]["unionWith"][0], 2.0);
  EXPECT_GT(y["scale"]["domain"]["unionWith"][1], 2.0);
}

TEST(SheetsPage, HasALegendForSeveralCurvesOnly) {
  auto all = sheets();
  EXPECT_NE(html(all, "newmark", {}).find("data-legend=\"decay\""), std::string::npos);
  all[2].columns.pop_back();
  for (auto& row : all[2].rows) row.pop_back();
  EXPECT_EQ(html(all, "newmark", {}).find("data-legend=\"decay\""), std::string::npos);
}

}  // namespace
}  // namespace clackers::report
