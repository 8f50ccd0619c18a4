#include "clackers/solvers/work_folder.hpp"

#include <gtest/gtest.h>

namespace clackers::solvers {
namespace {

namespace fs = std::filesystem;

TEST(WorkFolder, RunsOfTwoInOneFolderDoNotMeet) {
  const auto path = (fs::path(testing::TempDir()) / "work_folder").string();
  {
    WorkFolder work(path), other_work(path);
    const RunFolder first(work, "a", "key"), second(other_work, "b", "key");
    EXPECT_NE(first.path(), second.path());
    EXPECT_TRUE(fs::exists(first.path()));
    EXPECT_TRUE(fs::exists(second.path()));
  }
  EXPECT_TRUE(fs::is_empty(path));
  fs::remove_all(path);
}

}  // namespace
}  // namespace clackers::solvers
