#include "clackers/solvers/command_template.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/base/text.hpp"

namespace clackers::solvers {
namespace {

namespace fs = std::filesystem;

std::vector<PlaceholderValue> values(const std::string& out = "/tmp/o.csv") {
  return {{"case", "/tmp/p.json"}, {"case:text", "/tmp/p.txt"}, {"h", "0.05"}, {"n", "400"},
          {"tolerance", "1e-06"},  {"events", "/tmp/e.csv"},    {"out", out}};
}

std::string filled(const std::string& command) { return CommandTemplate(command).filled(values()); }

TEST(CommandTemplate, ReplacesPlaceholders) {
  EXPECT_EQ(filled("run {case} {case:text} {h} {n} {tolerance} {events} {out}"),
            "run /tmp/p.json /tmp/p.txt 0.05 400 1e-06 /tmp/e.csv /tmp/o.csv");
  EXPECT_TRUE(CommandTemplate("run {h}").uses("h"));
  EXPECT_FALSE(CommandTemplate("run {h}").uses("out"));
}

TEST(CommandTemplate, QuotesValuesThatAShellWouldRead) {
  EXPECT_EQ(CommandTemplate("run {h} {out}").filled(values("/it's a/$x")),
            "run 0.05 '/it'\\''s a/$x'");
}

TEST(CommandTemplate, LeavesOtherBracesAlone) {
  EXPECT_EQ(filled("awk '{print $1}' ${n} {a,b} {} {{out}} {h}"),
            "awk '{print $1}' ${n} {a,b} {} {out} 0.05");
}

TEST(CommandTemplate, RefusesOtherPlaceholders) {
  EXPECT_REFUSED(CommandTemplate("run {h} {otu}"), "unknown-name", "\"otu\"", "\"out\"");
  EXPECT_REFUSED(CommandTemplate("run {h} {H}"), "unknown-name", "\"H\"");
  EXPECT_REFUSED(CommandTemplate("run {out}"), "bad-syntax", "{h}, {n}, {tolerance} or {runs}");
  EXPECT_REFUSED(CommandTemplate(" \t"), "bad-syntax", "empty");
}

TEST(CommandTemplate, MakesFilesFromHereAbsolute) {
  const auto folder = fs::temp_directory_path() / "clackers command template";
  fs::create_directories(folder);
  std::ofstream(folder / "my solver.py") << "x";
  std::ofstream(folder / "cat") << "x";
  const auto before = fs::current_path();
  fs::current_path(folder);
  const CommandTemplate command("A=1 ./cat {h}; python3 'my solver.py' cat -- my; cat $cat");
  const auto line = command.filled(values());
  const auto identity = command.identity();
  std::ofstream("cat") << "xy";
  const auto changed = command.identity();
  fs::current_path(before);
  fs::remove_all(folder);
  const auto here = folder.string() + "/";
  // The last cat is a command, not the file; so is the first one, by its path.
  EXPECT_EQ(line, "A=1 '" + here + "cat' 0.05; python3 '" + here + "my solver.py' '" + here +
                      "cat' -- my; cat $cat");
  EXPECT_NE(identity.find(here + "my solver.py 1 "), std::string::npos) << identity;
  EXPECT_NE(identity.find("/bin/cat "), std::string::npos) << identity;
  EXPECT_NE(identity, changed);
}

TEST(CommandTemplate, BracesInTheNameOfAFileAreNoPlaceholders) {
  const auto folder = fs::path(testing::TempDir()) / "{h} {{out}} ${n} {x";
  fs::create_directories(folder);
  const auto file = (folder / "solver.so").string();
  std::ofstream{file} << "x";
  EXPECT_EQ(filled("run " + shell_quoted(file) + " {h}"), "run '" + file + "' 0.05");
  fs::remove_all(folder);
}

TEST(CommandTemplate, HasTheNameOfTheProgram) {
  EXPECT_EQ(CommandTemplate("./bin/solver.exe {h}").name(), "solver");
  EXPECT_EQ(CommandTemplate("A=1 no-such-program {h}").name(), "no-such-program");
  EXPECT_EQ(CommandTemplate("$SOLVER {h}").name(), "program");
}

}  // namespace
}  // namespace clackers::solvers
