#include "clackers/campaign/atlas.hpp"

#include <gtest/gtest.h>

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
  ladder.neighbours = 4;
  ladder.coarsest = 0.1;
  ladder.tolerances = {1e-3, 1e-5};
  EXPECT_EQ(ladder_options(ladder),
            "--levels 5 --neighbours 4 --coarsest 0.1 --tolerances 0.001,1e-05");
}

}  // namespace
}  // namespace clackers::campaign
