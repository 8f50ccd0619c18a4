#include "paper/reproduce.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "clackers/base/error.hpp"
#include "clackers/base/files/files.hpp"
#include "clackers/base/files/json.hpp"
#include "paper/testing/test_folder.hpp"

namespace clackers::paper {
namespace {

namespace fs = std::filesystem;

// Without programs to draw with, so that the test needs none.
class Reproduced : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    ::setenv("PATH", "", 1);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& file : fs::directory_iterator(folder_)) out.push_back(file.path().filename());
    std::ranges::sort(out);
    return out;
  }
};

TEST_F(Reproduced, FolderWithoutRenderersHasNumbersSpecificationsAndPage) {
  const auto made = reproduce(chosen({"fig2", "fig1"}), folder_, "clackers paper");
  ASSERT_EQ(made.missing.size(), 1u);
  EXPECT_FALSE(made.interrupted);
  EXPECT_EQ(names(), (std::vector<std::string>{"fig1.csv", "fig1.vl.json", "fig2.csv",
                                               "fig2.vl.json", "index.html", "paper.json"}));
  auto listed = listed_files(folder_);
  std::ranges::sort(listed);
  EXPECT_EQ(listed, names());
  EXPECT_NE(read_file(folder_ / "index.html").find("could not be drawn"), std::string::npos);
}

TEST_F(Reproduced, ManifestHasClaimsAndVerdicts) {
  const auto made = reproduce(chosen({"fig1"}), folder_, "clackers paper fig1");
  const auto json = parse_json(read_file(folder_ / "paper.json"));
  EXPECT_EQ(json.at("schema"), "clackers/paper-folder/1");
  EXPECT_EQ(json.at("command"), "clackers paper fig1");
  const auto& claims = json.at("figures").at(0).at("claims");
  ASSERT_EQ(claims.size(), made.figures.at(0).claims.size());
  EXPECT_EQ(claims[0].at("verdict"), "holds");
  EXPECT_EQ(claims[0].at("measured"), made.figures[0].claims[0].measured);
}

TEST_F(Reproduced, InterruptLeavesAnIncompleteFolder) {
  const std::atomic<bool> stop{true};
  const auto made = reproduce(chosen({}), folder_, "", {}, &stop);
  EXPECT_TRUE(made.interrupted);
  EXPECT_EQ(made.figures.size(), 1u);
  EXPECT_FALSE(fs::exists(folder_ / "paper.json"));
}

TEST_F(Reproduced, ForeignManifestListsNoFiles) {
  EXPECT_TRUE(listed_files(folder_).empty());
  for (const auto* text : {"no json", "[]", "{\"schema\": \"other/1\", \"files\": [\"a\"]}",
                           "{\"schema\": 3, \"files\": [\"a\"]}"}) {
    write_file(folder_ / "paper.json", text);
    EXPECT_TRUE(listed_files(folder_).empty()) << text;
  }
}

TEST_F(Reproduced, MissingFolderIsAFileError) {
  EXPECT_THROW(reproduce(chosen({"fig2"}), folder_ / "not-there", ""), FileError);
}

}  // namespace
}  // namespace clackers::paper
