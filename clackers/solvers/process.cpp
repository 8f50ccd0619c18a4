#include "clackers/solvers/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/base/files.hpp"

namespace clackers::solvers {
namespace {

using Clock = std::chrono::steady_clock;
using End = ProcessResult::End;

// A signal handler may neither lock nor allocate, hence a fixed table; 0: free.
std::array<std::atomic<pid_t>, 1024> groups{};
static_assert(std::atomic<pid_t>::is_always_lock_free);
// Calls of kill_processes(); tells start() of one that came before its process was in the table.
std::atomic<unsigned> kills = 0;
static_assert(std::atomic<unsigned>::is_always_lock_free);

struct Pipe {
  Descriptor read, write;
  bool make() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return false;
    read = Descriptor(ends[0]);
    write = Descriptor(ends[1]);
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
    return true;
  }
};

// One process with its group. Between start() and reap() it exists, at least as a zombie, so that
// its number means no other process.
class Child {
 public:
  Child() = default;
  ~Child() { reap(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// 0 or the system's error number.
  int start(const ProcessTask& task, int output, int error) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawn_file_actions_addchdir_np(&actions, task.folder.c_str());
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, error, STDERR_FILENO);
    ::posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
    sigset_t none, all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_setflags(
        &attributes,
        static_cast<short>(POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF));
    ::posix_spawnattr_setpgroup(&attributes, 0);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    std::string shell = "/bin/sh", option = "-c", command = task.command;
    std::array<char*, 4> arguments{shell.data(), option.data(), command.data(), nullptr};
    const unsigned kills_before = kills;
    const int problem = ::posix_spawn(&number_, shell.c_str(), &actions, &attributes,
                                      arguments.data(), environment().data());
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    if (problem != 0) {
      number_ = 0;
      return problem;
    }
    for (auto& entry : groups) {
      pid_t free = 0;
      if (entry.compare_exchange_strong(free, number_)) break;
    }
    if (kills != kills_before) kill_group();
    return 0;
  }

  bool has_ended() const {
    siginfo_t info{};
    return ::waitid(P_PID, id_t(number_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           info.si_pid == number_;
  }

  void kill_group() const { ::kill(-number_, SIGKILL); }

  /// Kills the group, waits for the process and fills in how it ended.
  void reap(ProcessResult* result = nullptr) {
    if (number_ == 0) return;
    kill_group();
    int status = 0;
    while (::waitpid(number_, &status, 0) < 0 && errno == EINTR) {
    }
    for (auto& entry : groups) {
      pid_t mine = number_;
      if (entry.compare_exchange_strong(mine, 0)) break;
    }
    number_ = 0;
    if (result == nullptr || result->end != End::exited) return;
    if (WIFSIGNALED(status)) result->end = End::signalled;
    result->status = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  }

 private:
  // Ours, with the folder that we run in as OLDPWD.
  std::vector<char*> environment() {
    std::error_code error;
    old_folder_ = "OLDPWD=" + std::filesystem::current_path(error).string();
    std::vector<char*> entries;
    for (char** entry = ::environ; *entry != nullptr; ++entry)
      if (!std::string_view(*entry).starts_with("OLDPWD=")) entries.push_back(*entry);
    entries.push_back(old_folder_.data());
    entries.push_back(nullptr);
    return entries;
  }

  pid_t number_ = 0;
  std::string old_folder_;
};

// Takes what a process writes until it ends.
class Reader {
 public:
  Reader(const ProcessTask& task, const std::atomic<bool>* interrupt)
      : task_(task), interrupt_(interrupt) {}

  ProcessResult run() {
    if (!task_.output.empty()) {
      file_ =
          Descriptor(::open(task_.output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
      if (!file_.is_open()) fail_to_write();
    }
    Pipe output, error;
    if (!output.make() || !error.make()) return not_started(errno);
    Child child;
    if (const int problem = child.start(task_, output.write.number(), error.write.number()))
      return not_started(problem);
    output.write.close();
    error.write.close();
    output_ = std::move(output.read);
    error_ = std::move(error.read);
    const auto limit = Clock::now() + std::chrono::duration<double>(task_.timeout);
    while (result_.end == End::exited) {
      const bool ended = child.has_ended();
      if (ended) child.kill_group();  // what it left running could write for ever
      wait(ended ? 0 : pause_);
      const bool heard = take(output_, true) + take(error_, false) > 0;
      const bool late = Clock::now() >= limit;
      if (ended && (!heard || late)) break;
      if (interrupt_ != nullptr && *interrupt_) result_.end = End::interrupted;
      if (late) result_.end = End::timed_out;
    }
    child.reap(&result_);
    return std::move(result_);
  }

 private:
  ProcessResult not_started(int problem) {
    result_.end = End::not_started;
    result_.status = problem;
    return std::move(result_);
  }

  // Until something was written, closed, or the time has passed [ms].
  void wait(int time) {
    std::array<pollfd, 2> watched{pollfd{output_.number(), POLLIN, 0},
                                  pollfd{error_.number(), POLLIN, 0}};
    ::poll(watched.data(), watched.size(), time);
    // A process that closed both and goes on is looked at less and less often.
    const bool closed = !output_.is_open() && !error_.is_open();
    pause_ = closed ? std::min(2 * pause_, longest_pause) : longest_pause;
  }

  // Reads once; returns the number of bytes.
  std::size_t take(Descriptor& from, bool is_output) {
    if (!from.is_open()) return 0;
    const auto count = ::read(from.number(), buffer_.data(), buffer_.size());
    if (count == 0) {
      from.close();
      pause_ = 1;
    }
    if (count <= 0) return 0;
    const auto size = static_cast<std::size_t>(count);
    if (is_output && file_.is_open() && (taken_ += size) > most_output) result_.end = End::flooded;
    if (is_output && file_.is_open())
      write(size);
    else
      keep({buffer_.data(), size});
    return size;
  }

  void write(std::size_t size) {
    for (std::size_t done = 0; done < size;) {
      const auto count = ::write(file_.number(), buffer_.data() + done, size - done);
      if (count < 0 && errno != EINTR) fail_to_write();
      if (count > 0) done += static_cast<std::size_t>(count);
    }
  }

  void keep(std::string_view text) {
    result_.printed += text;
    if (result_.printed.size() > most_printed)
      result_.printed.erase(0, result_.printed.size() - most_printed);
  }

  [[noreturn]] void fail_to_write() const {
    throw FileError(task_.output + ": " + std::generic_category().message(errno) + '.',
                    "cannot-write");
  }

  static constexpr int longest_pause = 20;  // [ms]

  const ProcessTask& task_;
  const std::atomic<bool>* interrupt_;
  Descriptor file_, output_, error_;
  std::array<char, 65536> buffer_{};
  std::size_t taken_ = 0;
  int pause_ = longest_pause;
  ProcessResult result_;
};

}  // namespace

ProcessResult run_process(const ProcessTask& task, const std::atomic<bool>* interrupt) {
  return Reader(task, interrupt).run();
}

void kill_processes() noexcept {
  ++kills;
  for (auto& entry : groups)
    if (const pid_t group = entry.load(); group > 0) ::kill(-group, SIGKILL);
}

}  // namespace clackers::solvers
