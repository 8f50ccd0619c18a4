#include "clackers/solvers/work_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "clackers/base/error.hpp"

namespace clackers::solvers {
namespace {

namespace fs = std::filesystem;

class WorkFolders : public testing::Test {
 protected:
  WorkFolders() {
    fs::create_directories(cache_);
    ::setenv("XDG_CACHE_HOME", cache_.c_str(), 1);
  }
  ~WorkFolders() override {
    ::unsetenv("XDG_CACHE_HOME");
    fs::remove_all(cache_);
  }

  fs::path good_run(const std::string& key) {
    WorkFolder work({});
    RunFolder mine(work, "run", key);
    return mine.commit(true);
  }
  void sweep(const std::string& path = {}) {
    WorkFolder work(path);
    const RunFolder run(work, "a", "key");
  }
  void make_old(const fs::path& path, std::chrono::hours age = WorkFolder::longest_unused) {
    fs::last_write_time(path, fs::file_time_type::clock::now() - age - std::chrono::hours(1));
  }

  fs::path cache_ =
      fs::path(testing::TempDir()) /
      (std::string("work_folder-") + testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::path programs_ = cache_ / "clackers" / "programs";
};

TEST_F(WorkFolders, RunsOfTwoInOneFolderDoNotMeet) {
  WorkFolder work({}), other_work({});
  {
    const RunFolder first(work, "a", "key"), second(other_work, "b", "key");
    EXPECT_NE(first.path(), second.path());
    EXPECT_TRUE(fs::exists(first.path()));
    EXPECT_TRUE(fs::exists(second.path()));
  }
  EXPECT_TRUE(fs::is_empty(programs_));
}

TEST_F(WorkFolders, OldRunsAreRemovedAndNothingElse) {
  const auto unused = good_run("unused"), used = good_run("used");
  const auto other = programs_ / "mine", link = programs_ / "link";
  const auto forged = programs_ / "run-0123456789abcdef";
  for (const auto& folder : {other, forged}) {
    fs::create_directory(folder);
    std::ofstream(folder / "key.txt") << "mine";
    make_old(folder);
  }
  fs::create_directory_symlink(used, link);
  make_old(unused);
  const WorkFolder without_a_run({});
  EXPECT_TRUE(fs::exists(unused));
  sweep();
  EXPECT_FALSE(fs::exists(unused));
  for (const auto& folder : {used, other, forged, link}) EXPECT_TRUE(fs::exists(folder)) << folder;
}

TEST_F(WorkFolders, RunsOfKilledProcessesAreRemovedWhereTheirLockIsFree) {
  WorkFolder work({});
  const RunFolder running(work, "a", "key");
  const auto killed = programs_ / ".running-killed", strange = programs_ / ".running-strange";
  fs::copy(running.path(), killed, fs::copy_options::recursive);
  fs::create_directory(strange);
  for (const auto& folder : {running.path(), killed, strange})
    make_old(folder, WorkFolder::longest_killed);
  for (const auto& path : {std::string(), programs_.string()}) {
    sweep(path);
    EXPECT_FALSE(fs::exists(killed));
    EXPECT_TRUE(fs::exists(running.path()));
    EXPECT_TRUE(fs::exists(strange));
    fs::copy(running.path(), killed, fs::copy_options::recursive);
    make_old(killed, WorkFolder::longest_killed);
  }
}

TEST_F(WorkFolders, ACacheThatOthersMayChangeIsRefused) {
  const auto refused = [&] {
    try {
      WorkFolder({});
    } catch (const FileError& error) {
      return std::string(error.what()).find("XDG_CACHE_HOME") != std::string::npos;
    }
    return false;
  };
  EXPECT_FALSE(refused());
  EXPECT_EQ(fs::status(programs_).permissions(), fs::perms::owner_all);
  for (const auto& folder : {programs_, programs_.parent_path()})
    for (const auto may : {fs::perms::group_write, fs::perms::others_write}) {
      fs::permissions(folder, may, fs::perm_options::add);
      EXPECT_TRUE(refused()) << folder;
      fs::permissions(folder, may, fs::perm_options::remove);
    }
  EXPECT_FALSE(refused());
  fs::rename(programs_, cache_ / "elsewhere");
  fs::create_directory_symlink(cache_ / "elsewhere", programs_);
  EXPECT_TRUE(refused());
  fs::remove(programs_);
  std::ofstream{programs_} << "file";
  EXPECT_TRUE(refused());
}

TEST_F(WorkFolders, ARunThatReplacedItsFolderIsNotKept) {
  WorkFolder work({});
  const auto data = cache_ / "data";
  fs::create_directories(data);
  {
    RunFolder mine(work, "run", "key");
    fs::rename(mine.path(), cache_ / "moved");
    fs::rename(data, mine.path());
    EXPECT_THROW(mine.commit(true), FileError);
    fs::rename(mine.path(), data);
    fs::create_directory_symlink(data, mine.path());
    EXPECT_THROW(mine.commit(true), FileError);
    EXPECT_THROW(mine.write("seconds.txt", "1"), FileError);
    EXPECT_TRUE(fs::is_empty(data));
    fs::rename(mine.path(), cache_ / "link");
  }
  EXPECT_TRUE(fs::exists(data));
  EXPECT_FALSE(work.find("run", "key"));
}

TEST_F(WorkFolders, WhatAProgramPutsInPlaceOfTheKeyIsReplaced) {
  WorkFolder work({});
  RunFolder mine(work, "run", "key");
  fs::create_directories(mine.path() / "key.txt" / "folder");
  fs::create_symlink(cache_ / "precious", mine.path() / "problem.json");
  mine.write("problem.json", "{}");
  EXPECT_FALSE(fs::exists(cache_ / "precious"));
  const auto place = mine.commit(true);
  EXPECT_EQ(work.find("run", "key"), place);
}

TEST_F(WorkFolders, AnotherFolderInThePlaceOfARunStays) {
  const auto place = good_run("key");
  EXPECT_EQ(good_run("key"), place);  // ours is replaced
  fs::remove_all(place);
  fs::create_directory(place);
  std::ofstream(place / "notes.txt") << "mine";
  EXPECT_THROW(good_run("key"), FileError);
  EXPECT_TRUE(fs::exists(place / "notes.txt"));
  EXPECT_EQ(std::distance(fs::directory_iterator(programs_), {}), 1);
}

TEST_F(WorkFolders, FoldersWithoutPermissionsAreRemoved) {
  WorkFolder work({});
  {
    const RunFolder mine(work, "run", "key");
    fs::create_directories(mine.path() / "a" / "b");
    fs::permissions(mine.path() / "a", fs::perms::none);
    fs::permissions(mine.path(), fs::perms::owner_read | fs::perms::owner_exec);
  }
  EXPECT_TRUE(fs::is_empty(programs_));
}

}  // namespace
}  // namespace clackers::solvers
