#include "clackers/report/atlas.hpp"
#include "clackers/base/files/json.hpp"

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/report/atlas/survey.hpp"
#include "clackers/report/testing/sample_atlas.hpp"
#include "clackers/report/testing/written.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

std::string page_of(const SampleAtlas& atlas) {
  record::SheetRows runs(atlas.runs);
  const auto part = sample_part(atlas, runs);
  return atlas_page({&part, 1}, sample_atlas_text());
}

nlohmann::ordered_json atlas_data(const std::string& page) {
  const auto from = page.find('>', page.find("id=\"data\">")) + 1;
  return parse_json(page.substr(from, page.find("</script>", from) - from))["atlas"];
}

TEST(Atlas, IsOneFileThatLoadsNothing) {
  const auto page = page_of(sample_atlas());
  EXPECT_LT(page.size(), 2000000u);
  for (const auto part : {"<script src", "<link rel=\"stylesheet\"", "@import", "url("})
    EXPECT_FALSE(has(page.substr(0, page.find("id=\"data\"")), part)) << part;
  const auto from = page.find("Content-Security-Policy");
  const auto policy = page.substr(from, page.find('>', from) - from);
  EXPECT_EQ(occurrences(policy, "'sha256-"), occurrences(page, "<script>"));
}

TEST(Atlas, HasEverySubjectWithItsRuns) {
  const auto atlas = sample_atlas();
  const auto data = atlas_data(page_of(atlas));
  EXPECT_EQ(data["systems"].size(), 7u);
  EXPECT_EQ(data["methods"].size(), 8u);
  EXPECT_EQ(data["cells"].size(), atlas.subjects.rows.size());
  std::map<std::string, std::size_t> place;
  for (const auto& field : data["fields"]) place[field] = place.size();
  std::size_t runs = 0, refused = 0;
  for (const auto& cell : data["cells"]) {
    ASSERT_EQ(cell.size(), place.size());
    runs += cell[place["errors"]].size();
    const auto& ladder = data["ladders"][cell[place["ladder"]].get<std::size_t>()];
    EXPECT_EQ(ladder["steps"].size(), cell[place["errors"]].size());
    EXPECT_EQ(ladder["runs"].size(), cell[place["forces"]].size());
    if (!data["words"][cell[place["refusal_code"]].get<std::size_t>()].get<std::string>().empty())
      ++refused;
  }
  EXPECT_EQ(refused, 7u);
  EXPECT_EQ(runs, atlas.runs.rows.size());
}

TEST(Atlas, CommandsNameTheSystemAndTheMethodAsAShellReadsThem) {
  auto atlas = sample_atlas(1, 1);
  record::SheetRows runs(atlas.runs);
  auto part = sample_part(atlas, runs);
  part.calls["rk4"] = "--exec './solver {h}'";
  const auto data = atlas_data(atlas_page({&part, 1}, sample_atlas_text()));
  EXPECT_EQ(data["systems"][0]["command"], "--case three-parameter --set N=1,xi1=0.05");
  EXPECT_EQ(data["systems"][1]["command"], "--case stop");
  EXPECT_EQ(data["methods"][2]["call"], "--exec './solver {h}'");
  EXPECT_EQ(data["methods"][4]["call"], "newmark+reversal");
  EXPECT_EQ(data["methods"][4]["treatment"], "reversal");
}

TEST(Atlas, ProfilesCountTheTasksOfAllSystems) {
  const auto data = atlas_data(page_of(sample_atlas(1, 1)));
  ASSERT_EQ(data["profiles"].size(), 2u);
  EXPECT_EQ(data["profiles"][0]["counter"], "force_evaluations");
  EXPECT_GT(data["profiles"][0]["tasks"], 2);
  EXPECT_EQ(data["profiles"][0]["lines"].size(), 8u);
  EXPECT_TRUE(data["profiles"][0]["lines"][7][0].empty()) << "the refused method solves nothing";
}

TEST(Atlas, PartsOfOthersStandBesideWithTheirOrigin) {
  const auto own = sample_atlas(1, 1), other = sample_atlas(1, 1);
  record::SheetRows first(own.runs), second(other.runs);
  const std::array parts{sample_part(own, first), sample_part(other, second, "A. Author")};
  const auto page = atlas_page(parts, sample_atlas_text());
  const auto data = atlas_data(page);
  EXPECT_EQ(data["systems"].size(), 2u);
  EXPECT_EQ(data["methods"].size(), 16u);
  EXPECT_EQ(data["methods"][9]["part"], 1);
  EXPECT_EQ(data["parts"][1]["origin"], "A. Author");
  EXPECT_TRUE(has(page, "<th scope=\"row\">A. Author</th>"));
}

TEST(Atlas, RefusesNothingAndTheSameCellTwice) {
  auto atlas = sample_atlas(1, 1);
  auto row = atlas.subjects.rows.front();
  row[0] = 99LL;
  atlas.subjects.rows.push_back(row);
  EXPECT_REFUSED(page_of(atlas), "bad-syntax",
                 {"newmark appears twice on three-parameter N=1,xi1=0.05"});
  atlas.subjects.rows.clear();
  EXPECT_REFUSED(page_of(atlas), "not-a-campaign", {"clackers campaign run"});
}

TEST(Atlas, CommandsHaveNoControlCharacters) {
  auto atlas = sample_atlas(1, 1);
  for (auto& row : atlas.subjects.rows)
    if (row[2].index() != 0) row[2] = std::string("\x03 sh\n");
  record::SheetRows runs(atlas.runs);
  auto part = sample_part(atlas, runs);
  part.calls["rk4"] = "--exec '\x1b[201~'";
  const auto data = atlas_data(atlas_page({&part, 1}, sample_atlas_text()));
  EXPECT_EQ(data["systems"][0]["command"],
            "--case three-parameter --set 'N=\\x03 sh\\x0a,xi1=0.05'");
  EXPECT_EQ(data["methods"][2]["call"], "--exec '\\x1b[201~'");
  EXPECT_EQ(data["methods"][2]["program"], true);
  EXPECT_EQ(data["methods"][4]["program"], false);
}

TEST(Atlas, RefusesMoreCellsThanAReaderTakesIn) {
  EXPECT_NO_THROW(require_few_cells(most_cells));
  auto atlas = sample_atlas(1, 1);
  atlas.subjects.rows.resize(std::size_t(most_cells) + 1, atlas.subjects.rows.front());
  EXPECT_REFUSED(page_of(atlas), "too-many-rows", "allowed: 20000", "clackers campaign query");
}

}  // namespace
}  // namespace clackers::report
