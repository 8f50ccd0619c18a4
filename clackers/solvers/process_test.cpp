#include "clackers/solvers/process.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "clackers/base/error.hpp"

namespace clackers::solvers {
namespace {

namespace fs = std::filesystem;
using End = ProcessResult::End;

class Process : public testing::Test {
 protected:
  Process() { fs::create_directories(folder_); }
  ~Process() override { fs::remove_all(folder_); }

  ProcessResult run(const std::string& command, double timeout = 10.0,
                    const std::string& output = {}, const std::atomic<bool>* interrupt = nullptr) {
    return run_process({command, folder_.string(), timeout, output}, interrupt);
  }

  fs::path folder_ =
      fs::temp_directory_path() / (std::string("clackers-process-") +
                                   testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Process, RunsInItsFolderAndKnowsOurs) {
  const auto result = run("pwd; echo $OLDPWD >&2; cat");
  EXPECT_EQ(result.end, End::exited);
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.printed.find(folder_.string() + "\n"), std::string::npos);
  EXPECT_NE(result.printed.find(fs::current_path().string() + "\n"), std::string::npos);
}

TEST_F(Process, GivesExitStatusAndSignal) {
  EXPECT_EQ(run("exit 7").status, 7);
  const auto result = run("kill -SEGV $$");
  EXPECT_EQ(result.end, End::signalled);
  EXPECT_EQ(result.status, SIGSEGV);
}

TEST_F(Process, KeepsTheEndOfWhatItPrinted) {
  // In one stream: what comes from two may be read in another order.
  const auto result = run("{ head -c 100000 /dev/zero | tr '\\0' x; echo end; } >&2");
  EXPECT_EQ(result.printed.size(), most_printed);
  EXPECT_TRUE(result.printed.ends_with("xend\n"));
}

TEST_F(Process, WritesStandardOutputToAFile) {
  const auto file = (folder_ / "out").string();
  EXPECT_EQ(run("echo text; echo error >&2", 10.0, file).printed, "error\n");
  std::string text;
  std::getline(std::ifstream(file), text);
  EXPECT_EQ(text, "text");
  EXPECT_THROW(run("echo", 10.0, "/no/folder/out"), FileError);
}

TEST_F(Process, EndsAfterItsTimeWithItsChildren) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(run("sleep 5 & echo $! > child; exec > /dev/null 2>&1; sleep 5", 0.03).end,
            End::timed_out);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(4));
  int child = 0;
  std::ifstream(folder_ / "child") >> child;
  ASSERT_GT(child, 0);
  // Killed; it ends a moment later, and whoever inherits it may wait for it later still.
  const auto has_ended = [&] {
    std::string word;
    std::ifstream status("/proc/" + std::to_string(child) + "/stat");
    status >> word >> word >> word;
    return !status || word == "Z" || word == "X";
  };
  while (!has_ended() && std::chrono::steady_clock::now() - start < std::chrono::seconds(4))
    std::this_thread::yield();
  EXPECT_TRUE(has_ended());
}

TEST_F(Process, LeavesNoChildInTheBackground) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(run("sleep 5 &").end, End::exited);
  EXPECT_EQ(run("yes &").end, End::exited);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(4));
}

TEST_F(Process, EndsWhenInterrupted) {
  std::atomic<bool> interrupt = true;
  EXPECT_EQ(run("sleep 5", 10.0, {}, &interrupt).end, End::interrupted);
}

TEST_F(Process, IsKilledByAnEndOfTheProgram) {
  ProcessResult result;
  std::thread other([&] { result = run("echo > ready; sleep 5"); });
  while (!fs::exists(folder_ / "ready")) std::this_thread::yield();
  kill_processes();
  other.join();
  EXPECT_EQ(result.end, End::signalled);
}

TEST_F(Process, IsNotStartedInAFolderThatIsNot) {
  EXPECT_EQ(run_process({"true", "/no/folder", 1.0, {}}).end, End::not_started);
}

}  // namespace
}  // namespace clackers::solvers
