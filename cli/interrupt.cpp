#include "cli/interrupt.hpp"

#include <unistd.h>

#include <exception>
#include <new>
#include <string_view>

#include "clackers/base/files/input_file.hpp"
#include "clackers/solvers/process_tree.hpp"

namespace clackers::cli {
namespace {

std::atomic<bool> interrupted{false};

// Programs that were started do not outlive us, and write nothing more.
void end_work() {
  make_none_on_exit();
  solvers::kill_processes();
  remove_on_exit();
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

constexpr std::string_view library_ended =
    "clackers: a library ended the program, most likely for lack of memory; ask for less. "
    "[out-of-memory]\n";

// The libraries of certified arithmetic abort when memory runs out, after a message of their own.
extern "C" void on_abort(int) { end_with(library_ended); }

// A function that promises not to throw met an exception, mostly for want of memory.
[[noreturn]] void on_terminate() {
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
    // Thrown inside such a function, as of <filesystem>, where no handler sees what it is.
    if (std::uncaught_exceptions() > 0) end_with(library_ended);
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

SignalsWait::SignalsWait() {
  sigset_t all;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before_);
}

SignalsWait::~SignalsWait() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace clackers::cli
