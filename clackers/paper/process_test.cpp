#include "clackers/paper/process.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "clackers/paper/render.hpp"
#include "clackers/paper/test_folder.hpp"

namespace clackers::paper {
namespace {

namespace fs = std::filesystem;

class Programs : public FolderTest {
 protected:
  std::string messages() const { return (folder_ / "messages").string(); }

  // A program of this name, the only one of our PATH besides the shell's own.
  void pretend(const std::string& name, const std::string& script) {
    fs::create_directory(folder_ / "bin");
    const auto file = folder_ / "bin" / name;
    std::ofstream(file) << "#!/bin/sh\n" << script << "\n";
    fs::permissions(file, fs::perms::owner_all);
    ::setenv("PATH", (folder_ / "bin").c_str(), 1);
  }
};

TEST_F(Programs, TellTheirExitCodeAndWhatTheySaid) {
  const auto ended = run_program({"sh", "-c", "echo out; echo wrong >&2; exit 3"}, messages());
  EXPECT_TRUE(ended.found);
  EXPECT_EQ(ended.code, 3);
  EXPECT_EQ(ended.messages, "wrong\n");
}

TEST_F(Programs, KilledOnesEndWith128AndTheSignal) {
  EXPECT_EQ(run_program({"sh", "-c", "kill -9 $$"}, messages()).code, 137);
}

TEST_F(Programs, AreGivenTheirArgumentsAsTheyAre) {
  EXPECT_EQ(run_program({"sh", "-c", "printf %s \"$1\" >&2", "sh", "a b'c"}, messages()).messages,
            "a b'c");
}

TEST_F(Programs, UnknownOnesAreNotFound) {
  EXPECT_FALSE(run_program({"clackers-has-no-such-program"}, messages()).found);
}

TEST_F(Programs, WithoutNodeNothingIsDrawnAndTheMessageSaysWhatToInstall) {
  ::setenv("PATH", folder_.c_str(), 1);
  const auto missing = render(folder_, {"fig1"});
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0].code.name(), "no-renderer");
  EXPECT_EQ(missing[0].sentence,
            "paper: pictures (svg, pdf) are missing: there is no program node on the PATH. Install "
            "it (Debian: apt-get install nodejs) and run the command again. The numbers (csv) and "
            "specifications (vl.json) were written all the same.");
  EXPECT_TRUE(fs::is_empty(folder_)) << "something stayed behind";
}

TEST_F(Programs, WithoutRsvgConvertPrintsAreMissing) {
  pretend("node", "exit 0");
  const auto missing = render(folder_, {"fig1"});
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0].code.name(), "no-renderer");
  EXPECT_NE(missing[0].sentence.find("prints (pdf) are missing"), std::string::npos);
  EXPECT_NE(missing[0].sentence.find("apt-get install librsvg2-bin"), std::string::npos);
}

TEST_F(Programs, ThatFailToDrawAreQuoted) {
  pretend("node", "echo 'fig1: no such scale' >&2; echo more >&2; exit 1");
  const auto missing = render(folder_, {"fig1"});
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0].code.name(), "render-failed");
  EXPECT_NE(missing[0].sentence.find("node failed with exit code 1: fig1: no such scale. The"),
            std::string::npos)
      << missing[0].sentence;
}

TEST_F(Programs, ThatFailToPrintAreQuoted) {
  pretend("node", "exit 0");
  pretend("rsvg-convert", "exit 5");
  const auto missing = render(folder_, {"fig1"});
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0].code.name(), "render-failed");
  EXPECT_NE(missing[0].sentence.find("rsvg-convert failed with exit code 5."), std::string::npos);
}

}  // namespace
}  // namespace clackers::paper
