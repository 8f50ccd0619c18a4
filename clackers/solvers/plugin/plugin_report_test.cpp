#include "clackers/solvers/plugin/plugin_report.hpp"

#include <gtest/gtest.h>

#include "clackers/base/error.hpp"

namespace clackers::solvers {
namespace {

TEST(PluginReport, IsReadAsItWasWritten) {
  const auto path = std::filesystem::path(testing::TempDir()) / "plugin_report";
  write({"prepare", "plugin-failed", "M is\nnot diagonal", "my solver", true}, path);
  const auto report = read_plugin_report(path);
  EXPECT_EQ(report.stage, "prepare");
  EXPECT_EQ(report.code, "plugin-failed");
  EXPECT_EQ(report.sentence, "M is\\x0anot diagonal");
  EXPECT_EQ(report.name, "my solver");
  EXPECT_TRUE(report.by_tolerance);
  write({"end", {}, {}, {}, false}, path);
  EXPECT_EQ(read_plugin_report(path).stage, "end");
  EXPECT_FALSE(read_plugin_report(path).by_tolerance);
  std::filesystem::remove(path);
}

TEST(PluginReport, WithoutAFileIsTheStart) {
  EXPECT_EQ(read_plugin_report("/nowhere/report").stage, "start");
  EXPECT_THROW(write({}, "/nowhere/report"), FileError);
}

}  // namespace
}  // namespace clackers::solvers
