#include "clackers/campaign/atlas.hpp"

#include <gtest/gtest.h>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/campaign/atlas/results.hpp"

namespace clackers::campaign {
namespace {

using Kind = MethodEntry::Kind;

Specification specification(const std::string& text) {
  return Specification::from_toml(text, "spec.toml");
}

constexpr auto small = R"(# Ä
methods = ["newmark", # Ö "ü" ]
  { exec = "ä {h}" }]  # é
metrics = ["u-max"]
[ladder]
levels = 3
[[cases]]
case = "three-parameter"
set = { xi1 = [0.1], N = { from = 1, to = 3, points = 3 } }
)";

AtlasResults sample() {
  AtlasResults results;
  results.origin = "A. \"Author\" \xC3\xA9";
  results.from = {"clackers atlas", "0.1.0", "GCC", "Linux", "a processor", "2026-01-01T00:00:00Z"};
  results.options = "--levels 3";
  results.calls = {{"ours", "--exec './a {h}' --name ours"}};
  results.specification = small;
  results.subjects.columns = {{"task", "", ""},   {"set_N", "", ""},   {"case", "", ""},
                              {"method", "", ""}, {"verdict", "", ""}, {"order", "", ""}};
  results.subjects.rows = {{0LL, 1.0, "stop", "ours", "agrees", 0.1},
                           {1LL, {}, "stop", "ours", "refused", {}}};
  results.runs.columns = {{"task", "", ""}, {"level", "", ""}, {"u_error", "", ""}};
  results.runs.rows = {{0LL, 1LL, 1e-300}, {0LL, 2LL, {}}};
  return results;
}

TEST(AtlasSpecification, HasEveryMethodAndSystemsBeyondThePair) {
  const auto shipped = specification(std::string(atlas_specification()));
  EXPECT_GT(shipped.methods().size(), 100u);
  EXPECT_GT(shipped.cases().size(), 8u);
  EXPECT_LT(shipped.tasks(), 10000);
}

TEST(WithMethods, KeepsSystemsAndLadder) {
  const std::vector<MethodEntry> methods{{Kind::catalogue, "rk4+penalty:law=hertz", {}, {}},
                                         {Kind::command, "./a 'b' {h}", "ours", "proper:2"}};
  const auto before = specification(small);
  const auto after = specification(with_methods(small, methods));
  ASSERT_EQ(after.methods().size(), 2u);
  EXPECT_EQ(after.methods()[0].text, "rk4+penalty:law=hertz");
  EXPECT_EQ(after.methods()[1].kind, Kind::command);
  EXPECT_EQ(after.methods()[1].text, "./a 'b' {h}");
  EXPECT_EQ(after.methods()[1].name, "ours");
  EXPECT_EQ(after.methods()[1].expect, "proper:2");
  EXPECT_NE(after.text().find(" ]  # \xC3\xA9\nmetrics"), std::string::npos) << after.text();
  EXPECT_EQ(after.systems(), before.systems());
  EXPECT_EQ(after.ladder().levels, before.ladder().levels);
  EXPECT_EQ(after.metrics(), before.metrics());
  const auto values = [](const System& system) {
    std::map<std::string, double> found;
    for (const auto& [name, value] : system.settings) found[name] = double(value);
    return found;
  };
  for (long long i = 0; i < before.systems(); ++i)
    EXPECT_EQ(values(after.system(i)), values(before.system(i))) << i;
}

TEST(LadderOptions, AreThoseOfVerify) {
  EXPECT_EQ(ladder_options({}), "--budget 0");
  Ladder ladder;
  ladder.levels = 5;
  ladder.samples_per_level = 4;
  ladder.coarsest = 0.1;
  ladder.tolerances = {1e-3, 1e-5};
  EXPECT_EQ(ladder_options(ladder),
            "--levels 5 --samples-per-level 4 --coarsest 0.1 --tolerances 0.001,1e-05");
}

TEST(AtlasResults, ReadBackAsTheyWere) {
  const auto results = sample();
  const auto read = results_from(results_text(results), "a.json");
  EXPECT_EQ(read.origin, results.origin);
  EXPECT_EQ(read.from.command, results.from.command);
  EXPECT_EQ(read.from.date, results.from.date);
  EXPECT_EQ(read.options, results.options);
  EXPECT_EQ(read.calls, results.calls);
  EXPECT_EQ(read.specification, results.specification);
  EXPECT_EQ(read.subjects.rows, results.subjects.rows);
  EXPECT_EQ(read.runs.rows, results.runs.rows);
}

TEST(AtlasResults, AreRefusedWithWhatIsWrong) {
  const auto text = results_text(sample());
  const auto with = [&](const std::string& from, const std::string& to) {
    auto changed = text;
    return changed.replace(changed.find(from), from.size(), to);
  };
  EXPECT_REFUSED(results_from("no", "a.json"), "bad-syntax", "a.json: this is no json");
  EXPECT_REFUSED(results_from("[1]", "a.json"), "not-a-campaign", "--submit METHOD");
  EXPECT_REFUSED(results_from(with("results/1", "results/2"), "a.json"), "other-version",
                 "clackers/atlas-results/1");
  EXPECT_REFUSED(results_from(with("\"verdict\"", "\"werdict\""), "a.json"), "no-column",
                 "there is no column verdict");
  EXPECT_REFUSED(results_from(with("[0,1,1e-300]", "[0,1]"), "a.json"), "ragged-row",
                 "row 1 has 2 values for 3 columns");
  EXPECT_REFUSED(results_from(with("[0,1,1e-300]", "[0,1,[2]]"), "a.json"), "bad-syntax",
                 "damaged");
  EXPECT_REFUSED(results_from(with("[1,null,\"stop\"", "[1,1.0,\"stop\""), "a.json"), "bad-syntax",
                 "the same system and method");
  EXPECT_REFUSED(results_from(with("\"options\"", "\"opinions\""), "a.json"), "bad-syntax",
                 "options");
}

}  // namespace
}  // namespace clackers::campaign
