#include "clackers/solvers/process.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "clackers/base/error.hpp"
#include "clackers/solvers/process_tree.hpp"

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
    return run_process(
        {.command = command, .folder = folder_.string(), .timeout = timeout, .output = output},
        interrupt);
  }

  // Whether processes whose numbers stand in the file "children" have ended; zombies have.
  bool are_gone(int count) {
    std::ifstream file(folder_ / "children");
    int found = 0, left = 0;
    for (int number = 0; file >> number; ++found) {
      std::string word;
      std::ifstream status("/proc/" + std::to_string(number) + "/stat");
      status >> word >> word >> word;
      left += status && word != "Z" && word != "X" ? 1 : 0;
    }
    EXPECT_EQ(found, count);
    return left == 0;
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
  // On a loaded machine a shell may take longer to begin.
  for (double timeout = 0.03; !fs::exists(folder_ / "children"); timeout *= 2.0) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(
        run("sleep 50 & echo $! > pid; mv pid children; exec > /dev/null 2>&1; sleep 50", timeout)
            .end,
        End::timed_out);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(40));
  }
  EXPECT_TRUE(are_gone(1));
}

TEST_F(Process, EndsChildrenThatLeftItsGroup) {
  const std::string detached = "sh -c 'echo $$ >> children; exec sleep 50' & ";
  const auto result = run(": > children; setsid " + detached + "nohup " + detached + "(setsid " +
                          detached + ") & (" + detached + ") & setsid setsid " + detached +
                          "while [ $(wc -l < children) -lt 5 ]; do :; done");
  EXPECT_EQ(result.end, End::exited);
  EXPECT_TRUE(are_gone(5));
}

TEST_F(Process, EndsWithItsSupervisor) {
  EXPECT_EQ(run("echo $$ > children; kill -9 $PPID; sleep 50").end, End::signalled);
  const auto start = std::chrono::steady_clock::now();
  while (!are_gone(1) && std::chrono::steady_clock::now() - start < std::chrono::seconds(4))
    std::this_thread::yield();
  EXPECT_TRUE(are_gone(1));
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

TEST_F(Process, IsEndedWhenItsStandardOutputIsTooLong) {
  ProcessTask task{
      .command = "yes", .folder = folder_.string(), .output = (folder_ / "out").string()};
  task.most_output = 100'000;
  EXPECT_EQ(run_process(task).end, End::flooded);
}

TEST_F(Process, IsNotStartedInAFolderThatIsNot) {
  EXPECT_EQ(run_process({.command = "true", .folder = "/no/folder"}).end, End::not_started);
}

}  // namespace
}  // namespace clackers::solvers
