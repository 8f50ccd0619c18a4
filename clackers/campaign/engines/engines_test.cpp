#include "clackers/campaign/engines.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "clackers/base/files/files.hpp"
#include "clackers/base/testing/test_file.hpp"
#include "clackers/campaign/specification.hpp"

namespace clackers::campaign {
namespace {

constexpr auto text = R"(name = "Ours"
integrates = "exactly"
licence = "MIT"
debian = ["libours-dev", "ours"]
version = "cat {folder}/version"
build = "cc -o {program} {folder}/ours.c"
command = "{program} {case:text} {h} {out}"
traps = ["None."]
steps = [0.02, 0.01]
[[facts]]
text = "It sleeps."
setting = "tuned"
case = "stop:eta=0.7"
quantity = "error"
from = 0.1
to = 0.2
source = "ours"
[[settings]]
name = "default"
why = "as it is"
[[settings]]
name = "tuned"
words = "tuned=1"
why = "no sleep"
expect = "proper:2"
)";

class Engines : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& content) {
    std::filesystem::create_directories(folder_ + "/" + name);
    write_file(folder_ + "/" + name + "/engine.toml", content);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  const std::string folder_ = TestFile("").path();
};

TEST_F(Engines, AreReadByName) {
  write("b", text);
  write("a", text);
  std::filesystem::create_directories(folder_ + "/node_modules");
  const auto engines = engines_in(folder_);
  ASSERT_EQ(engines.size(), 2u);
  EXPECT_EQ(engines[0].id, "a");
  EXPECT_EQ(engines[1].filled(engines[1].version), "cat " + folder_ + "/b/version");
  EXPECT_EQ(engines[1].filled(engines[1].build, "/p"), "cc -o /p " + folder_ + "/b/ours.c");
  EXPECT_EQ(engines[0].installation(), "apt-get install libours-dev ours");
  EXPECT_EQ(engine_of(engines, "b").settings[1].words, "tuned=1");
  EXPECT_REFUSED(engine_of(engines, "c"), "unknown-name", "engine", "clackers engines list");
}

TEST_F(Engines, WithoutAKeyOrWithAnUnknownOneAreRefused) {
  EXPECT_REFUSED(engines_in(folder_), "cannot-read", "engine.toml", "--engines");
  write("a", "name = \"Ours\"\n");
  EXPECT_REFUSED(engines_in(folder_), "no-column", "a/engine.toml", "integrates");
  write("a", std::string("versoin = \"1\"\n") + text);
  EXPECT_REFUSED(engines_in(folder_), "unknown-name", "versoin", "version");
  write("a", text + std::string("[[settings]]\nname = \"x\"\nwhy = \"y\"\nexpect = \"best\"\n"));
  EXPECT_REFUSED(engines_in(folder_), "unknown-name", "a/engine.toml:", "best");
}

TEST_F(Engines, SpecificationHasASubjectASetting) {
  write("a", text);
  const auto engines = engines_in(folder_);
  const std::vector<EngineRun> runs{{&engines[0], &engines[0].settings[0], "1.2", "/p"},
                                    {&engines[0], &engines[0].settings[1], "1.2", "/p"}};
  const auto specification =
      Specification::from_toml(engines_specification(runs, engine_cases()), "engines.toml");
  ASSERT_EQ(specification.methods().size(), 2u);
  EXPECT_EQ(specification.methods()[0].name, "a/default 1.2");
  EXPECT_EQ(specification.methods()[0].text, "/p {case:text} {h} {out}");
  EXPECT_EQ(specification.methods()[1].text, "/p {case:text} {h} {out} tuned=1");
  EXPECT_EQ(specification.methods()[1].expect, "proper:2");
  EXPECT_EQ(specification.methods()[1].labels.at("fact stop:eta=0.7"), "It sleeps.");
  EXPECT_FALSE(specification.methods()[0].labels.contains("fact stop:eta=0.7"));
  EXPECT_EQ(specification.methods()[0].labels.at("licence"), "MIT");
  EXPECT_EQ(specification.methods()[0].steps, (std::vector<double>{0.02, 0.01}));
  EXPECT_EQ(specification.systems(), 4);
}

}  // namespace
}  // namespace clackers::campaign
