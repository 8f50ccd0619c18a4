#include "cli/interrupt.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "clackers/base/input_file.hpp"
#include "clackers/solvers/process.hpp"

namespace clackers::cli {
namespace {

std::atomic<bool> interrupted{false};
// A signal handler may neither lock nor allocate, hence plain pointers in a fixed table.
std::array<std::atomic<const char*>, 16> paths_to_remove{};
static_assert(std::atomic<const char*>::is_always_lock_free);

// Where an entry of a folder has its length and its name, as getdents64 gives it; readdir allocates.
constexpr std::size_t length_offset = 16, name_offset = 19;

void remove_at(int parent, const char* name, int depth) {
  if (::unlinkat(parent, name, 0) == 0 || (errno != EISDIR && errno != EPERM) || depth > 8) return;
  const int folder = ::openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0) return;
  std::array<char, 4096> entries;
  while (true) {
    const long size = ::syscall(SYS_getdents64, folder, entries.data(), entries.size());
    if (size <= 0) break;
    for (const char* at = entries.data(); at < entries.data() + size;) {
      std::uint16_t length = 0;
      std::memcpy(&length, at + length_offset, sizeof length);
      const std::string_view entry = at + name_offset;
      if (entry != "." && entry != "..") remove_at(folder, entry.data(), depth + 1);
      at += length;
    }
  }
  ::close(folder);
  ::unlinkat(parent, name, AT_REMOVEDIR);
}

// Programs that were started do not outlive us, and write nothing more.
void end_work() {
  solvers::kill_processes();
  for (auto& entry : paths_to_remove)
    if (const char* path = entry.exchange(nullptr)) remove_path(path);
}

[[noreturn]] void end_with(std::string_view message) {
  end_work();
  [[maybe_unused]] const auto count = ::write(STDERR_FILENO, message.data(), message.size());
  ::_exit(4);
}

constexpr std::string_view out_of_memory =
    "clackers: not enough memory for this request; ask for less. [out-of-memory]\n";

extern "C" void on_stop(int) {
  if (!interrupted.exchange(true)) return;
  end_work();
  ::_exit(130);
}

extern "C" void on_end(int signal) {
  end_work();
  ::raise(signal);  // its default is in place again
}

// The libraries of certified arithmetic abort when memory runs out, after a message of their own.
extern "C" void on_abort(int) {
  end_with(
      "clackers: a library ended the program, most likely for lack of memory; ask for less. "
      "[out-of-memory]\n");
}

// A function that promises not to throw met an exception, mostly for want of memory.
[[noreturn]] void on_terminate() {
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    end_with(out_of_memory);
  } catch (...) {
  }
  end_with(
      "clackers: a mistake in the program. Please report it with your command. "
      "[internal-error]\n");
}

// Objects that exist before main() allocate, too, those of shared libraries among them.
void set_terminate_early() { std::set_terminate(on_terminate); }
[[gnu::section(".preinit_array"),
  gnu::used]] void (*const before_libraries)() = set_terminate_early;

void handle(int signal, void (*handler)(int), int flags) {
  struct sigaction ours {};
  struct sigaction inherited {};
  ours.sa_handler = handler;
  ours.sa_flags = flags;
  ::sigfillset(&ours.sa_mask);
  ::sigaction(signal, nullptr, &inherited);
  // Neither what the parent chose to ignore nor what a sanitizer handles.
  if (inherited.sa_handler == SIG_DFL) ::sigaction(signal, &ours, nullptr);
}

}  // namespace

void catch_signals() {
  end_reading_on(interrupted);
  // No SA_RESTART: a read that waits for a person must wake up.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) handle(signal, on_stop, 0);
  for (const int signal : {SIGQUIT, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGXCPU, SIGPWR,
                           SIGIO, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGSYS})
    handle(signal, on_end, static_cast<int>(SA_RESETHAND));
  handle(SIGABRT, on_abort, 0);
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
}

const std::atomic<bool>& interrupt_flag() { return interrupted; }

RemovedOnExit::RemovedOnExit(std::string path) : path_(std::move(path)) {
  for (auto& entry : paths_to_remove) {
    const char* free = nullptr;
    if (entry.compare_exchange_strong(free, path_.c_str())) return;
  }
  throw std::length_error("too many temporary files");
}

RemovedOnExit::~RemovedOnExit() {
  for (auto& entry : paths_to_remove) {
    const char* mine = path_.c_str();
    entry.compare_exchange_strong(mine, nullptr);
  }
}

void remove_path(const char* path) { remove_at(AT_FDCWD, path, 0); }

SignalsWait::SignalsWait() {
  sigset_t all;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before_);
}

SignalsWait::~SignalsWait() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace clackers::cli
