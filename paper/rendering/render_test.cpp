#include "paper/rendering/render.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "paper/testing/test_folder.hpp"

namespace clackers::paper {
namespace {

namespace fs = std::filesystem;

class Programs : public FolderTest {
 protected:
  // A program of this name, the only one of our PATH besides the shell's own.
  void pretend(const std::string& name, const std::string& script) {
    fs::create_directory(folder_ / "bin");
    const auto file = folder_ / "bin" / name;
    std::ofstream(file) << "#!/bin/sh\n" << script << "\n";
    fs::permissions(file, fs::perms::owner_all);
    ::setenv("PATH", (folder_ / "bin").c_str(), 1);
  }
};

TEST_F(Programs, ExitCodeAndStandardErrorAreReturned) {
  const auto ended = run_program({"sh", "-c", "echo out; echo wrong >&2; exit 3"});
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->code, 3);
  EXPECT_EQ(ended->messages, "wrong\n");
  EXPECT_EQ(run_program({"sh", "-c", "kill -9 $$"})->code, 137);
}

TEST_F(Programs, ArgumentsArePassedUnchanged) {
  EXPECT_EQ(run_program({"sh", "-c", "printf %s \"$1\" >&2", "sh", "a b'c"})->messages, "a b'c");
}

TEST_F(Programs, UnknownProgramGivesNothing) {
  EXPECT_FALSE(run_program({"clackers-has-no-such-program"}));
}

TEST_F(Programs, InterruptAndTimeLimitKillTheProgram) {
  const auto begin = std::chrono::steady_clock::now();
  const std::atomic<bool> interrupt{true};
  EXPECT_EQ(run_program({"sleep", "20"}, &interrupt)->code, 137);
  EXPECT_EQ(run_program({"sleep", "20"}, nullptr, std::chrono::seconds(0))->code, 137);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST_F(Programs, WithoutNodeNothingIsDrawnAndTheMessageNamesThePackage) {
  ::setenv("PATH", folder_.c_str(), 1);
  const auto missing = render(folder_, {"fig1"});
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0].code.name(), "no-renderer");
  EXPECT_EQ(
      missing[0].sentence,
      "paper: pictures (svg, pdf) are missing: there is no program node on the PATH. Install it (Debian: apt-get install nodejs) and run the command again. The numbers (csv) and specifications (vl.json) were written all the same.");
  EXPECT_TRUE(fs::is_empty(folder_)) << "something stayed behind";
}

TEST_F(Programs, WithoutRsvgConvertOnlyPdfIsMissing) {
  pretend("node", "exit 0");
  const auto missing = render(folder_, {"fig1"});
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0].code.name(), "no-renderer");
  EXPECT_NE(missing[0].sentence.find("prints (pdf) are missing"), std::string::npos);
  EXPECT_NE(missing[0].sentence.find("apt-get install librsvg2-bin"), std::string::npos);
}

TEST_F(Programs, FailureOfNodeIsQuoted) {
  pretend("node", "echo 'fig1: no such scale' >&2; echo more >&2; exit 1");
  const auto missing = render(folder_, {"fig1"});
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0].code.name(), "render-failed");
  EXPECT_NE(missing[0].sentence.find("node failed with exit code 1: fig1: no such scale. The"),
            std::string::npos)
      << missing[0].sentence;
}

TEST_F(Programs, FailureOfRsvgConvertIsQuoted) {
  pretend("node", "exit 0");
  pretend("rsvg-convert", "exit 5");
  const auto missing = render(folder_, {"fig1"});
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0].code.name(), "render-failed");
  EXPECT_NE(missing[0].sentence.find("rsvg-convert failed with exit code 5."), std::string::npos);
}

}  // namespace
}  // namespace clackers::paper
