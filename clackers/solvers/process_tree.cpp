#include "clackers/solvers/process_tree.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/base/jobs/removed_on_exit.hpp"

namespace clackers::solvers {
namespace {

using Clock = std::chrono::steady_clock;
using End = ProcessResult::End;

// A signal handler may neither lock nor allocate, hence a fixed table of supervisors; 0: free.
std::array<std::atomic<pid_t>, 1024> supervisors{};
static_assert(std::atomic<pid_t>::is_always_lock_free);
// Calls of kill_processes(); tells start() of one that came before its process was in the table.
std::atomic<unsigned> kills = 0;
static_assert(std::atomic<unsigned>::is_always_lock_free);

// What a supervisor says of its program.
struct Message {
  enum class Kind : int { started, not_started, ended } kind;
  int value;  ///< number of the process, error number, status of waitpid()
};

// All that happens after fork(), in a process that had threads, calls nothing that a signal handler
// may not call.
struct Start {
  const char *command, *folder;
  bool removes_folder;
  int output, error, messages;
  char** environment;
  pid_t parent;
};

void say(int to, Message::Kind kind, int value) {
  const Message message{kind, value};
  [[maybe_unused]] const auto count = ::write(to, &message, sizeof message);
}

void pause_briefly() {
  const timespec time{0, 1'000'000};
  ::nanosleep(&time, nullptr);
}

// What cannot be ended in this time, as with another user's rights, is left.
constexpr auto patience = std::chrono::seconds(5);

[[noreturn]] void become_program(const Start& start) {
  ::setpgid(0, 0);
  say(start.messages, Message::Kind::started, ::getpid());
  // From glibc 2.41 on SIGABRT has a lock, which another thread may have held at the fork. Of a handler exec
  // makes the default.
  for (int signal = 1; signal < NSIG; ++signal)
    if (signal != SIGABRT) ::signal(signal, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int null = ::open("/dev/null", O_RDONLY);
  constexpr int messages = STDERR_FILENO + 1;
  int says = start.messages;
  if (null >= 0 && ::chdir(start.folder) == 0 && ::dup2(start.output, STDOUT_FILENO) >= 0 &&
      ::dup2(start.error, STDERR_FILENO) >= 0 && ::dup2(null, STDIN_FILENO) >= 0 &&
      ::dup2(start.messages, messages) >= 0) {
    says = messages;
    ::fcntl(messages, F_SETFD, FD_CLOEXEC);
    ::closefrom(messages + 1);
    ::execle("/bin/sh", "/bin/sh", "-c", start.command, static_cast<char*>(nullptr),
             start.environment);
  }
  say(says, Message::Kind::not_started, errno);
  ::_exit(127);
}

// Whether the program has ended; it stays a zombie, so that its number means no other process.
bool is_over(pid_t program) {
  while (true) {
    siginfo_t info{};
    if (::waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == 0)
      return false;
    if (info.si_pid == program) return true;
    ::waitpid(info.si_pid, nullptr, 0);
  }
}

void kill_children() {
  const int file = ::open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
  std::array<char, 4096> text;
  pid_t number = 0;
  for (ssize_t size = 0; file >= 0 && (size = ::read(file, text.data(), text.size())) > 0;)
    for (const char c : std::string_view(text.data(), static_cast<std::size_t>(size)))
      if (c != ' ')
        number = 10 * number + (c - '0');
      else if (number > 0)
        ::kill(std::exchange(number, 0), SIGKILL);
  ::close(file);
}

// Ends the program's group at once, then children until none is left: those of an ended child become
// ours. Returns the status of the program.
int end_all(pid_t program) {
  int status = 0;
  ::kill(program, SIGKILL);
  ::kill(-program, SIGKILL);
  for (const auto limit = Clock::now() + patience; Clock::now() < limit; pause_briefly()) {
    kill_children();
    pid_t ended = 0;
    for (int found = 0; (ended = ::waitpid(-1, &found, WNOHANG)) > 0;)
      if (ended == program) status = found;
    if (ended < 0) break;
  }
  return status;
}

[[noreturn]] void supervise(const Start& start) {
  // Signals to our group do not end it before the program.
  ::setpgid(0, 0);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  // When the thread that started us ends: others of its process may end a moment later.
  ::prctl(PR_SET_PDEATHSIG, SIGHUP);
  ::signal(SIGCHLD, SIG_DFL);
  const pid_t program = ::_Fork();
  if (program == 0) become_program(start);
  if (program < 0) {
    say(start.messages, Message::Kind::not_started, errno);
    ::_exit(0);
  }
  ::setpgid(program, program);
  constexpr int messages = 0;
  ::dup2(start.messages, messages);
  ::closefrom(messages + 1);
  sigset_t awaited;
  ::sigemptyset(&awaited);
  ::sigaddset(&awaited, SIGCHLD);
  ::sigaddset(&awaited, SIGTERM);
  ::sigaddset(&awaited, SIGHUP);
  int signal = 0;
  while (signal != SIGTERM && signal != SIGHUP && ::getppid() == start.parent && !is_over(program))
    signal = ::sigwaitinfo(&awaited, nullptr);
  say(messages, Message::Kind::ended, end_all(program));
  for (const auto limit = Clock::now() + patience;
       signal == SIGHUP && ::getppid() == start.parent && Clock::now() < limit;)
    pause_briefly();
  if (start.removes_folder && ::getppid() != start.parent) remove_path(start.folder);
  ::_exit(0);
}

// Ours, with the folder that we run in as OLDPWD.
std::vector<char*> environment(std::string& old_folder) {
  std::error_code error;
  old_folder = "OLDPWD=" + std::filesystem::current_path(error).string();
  std::vector<char*> entries;
  for (char** entry = ::environ; *entry != nullptr; ++entry)
    if (!std::string_view(*entry).starts_with("OLDPWD=")) entries.push_back(*entry);
  entries.push_back(old_folder.data());
  entries.push_back(nullptr);
  return entries;
}

void ask_to_end(pid_t supervisor) {
  ::kill(supervisor, SIGTERM);
  ::kill(supervisor, SIGCONT);
}

bool has_ended(pid_t supervisor) {
  siginfo_t info{};
  return ::waitid(P_PID, id_t(supervisor), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
         info.si_pid == supervisor;
}

}  // namespace

bool Pipe::make() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return false;
  read = Descriptor(ends[0]);
  write = Descriptor(ends[1]);
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  return true;
}

ProcessTree::~ProcessTree() {
  ProcessResult result;
  end(result);
}

int ProcessTree::start(const ProcessTask& task, int output, int error) {
  if (!messages_.make()) return errno;
  std::string old_folder;
  auto variables = environment(old_folder);
  const Start start{.command = task.command.c_str(),
                    .folder = task.folder.c_str(),
                    .removes_folder = task.removes_folder,
                    .output = output,
                    .error = error,
                    .messages = messages_.write.number(),
                    .environment = variables.data(),
                    .parent = ::getpid()};
  const unsigned kills_before = kills;
  // The supervisor never runs our handlers.
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before);
  supervisor_ = ::_Fork();
  if (supervisor_ == 0) supervise(start);
  const int problem = supervisor_ < 0 ? errno : 0;
  for (auto& entry : supervisors) {
    pid_t free = 0;
    if (problem != 0 || entry.compare_exchange_strong(free, supervisor_)) break;
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  messages_.write.close();
  if (problem != 0)
    supervisor_ = 0;
  else if (kills != kills_before)
    ask_to_end(supervisor_);
  return problem;
}

bool ProcessTree::has_ended() const { return solvers::has_ended(supervisor_); }

void ProcessTree::end(ProcessResult& result) {
  if (supervisor_ == 0) return;
  ask_to_end(supervisor_);
  siginfo_t info{};
  while (::waitid(P_PID, id_t(supervisor_), &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
  }
  // After waitpid() its number may be another's, hence it leaves the table first.
  for (auto& entry : supervisors) {
    pid_t mine = supervisor_;
    if (entry.compare_exchange_strong(mine, 0)) break;
  }
  // With the time of the program: the supervisor has waited for all that it started.
  rusage used{};
  while (::wait4(supervisor_, nullptr, 0, &used) < 0 && errno == EINTR) {
  }
  result.seconds = double(used.ru_utime.tv_sec) + 1e-6 * double(used.ru_utime.tv_usec);
  supervisor_ = 0;
  std::array<int, 3> values{0, 0, -1};
  for (Message message{}; ::read(messages_.read.number(), &message, sizeof message) > 0;)
    values[std::size_t(message.kind)] = message.value;
  auto [program, problem, status] = values;
  if (status < 0) {  // something has killed the supervisor
    if (program > 0) ::kill(-program, SIGKILL);
    status = SIGKILL;
  }
  if (problem != 0) {
    result.end = End::not_started;
    result.status = problem;
  } else if (result.end == End::exited) {
    if (WIFSIGNALED(status)) result.end = End::signalled;
    result.status = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  }
}

void kill_processes() noexcept {
  ++kills;
  for (auto& entry : supervisors)
    if (const pid_t supervisor = entry.load(); supervisor > 0) ask_to_end(supervisor);
  const auto limit = Clock::now() + patience;
  for (auto& entry : supervisors)
    for (pid_t supervisor = 0;
         (supervisor = entry.load()) > 0 && !has_ended(supervisor) && Clock::now() < limit;)
      pause_briefly();
}

}  // namespace clackers::solvers
