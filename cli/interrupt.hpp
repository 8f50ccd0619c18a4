#pragma once

#include <signal.h>

#include <atomic>

#include "clackers/base/error.hpp"
#include "clackers/base/jobs/removed_on_exit.hpp"

namespace clackers::cli {

/// Thrown where work stops because a signal asked for it: Error with code interrupted, as the
/// modules throw it. Exit code 130 of the command.
class Interrupted : public Error {
 public:
  Interrupted() : Error("interrupted", "interrupted") {}
};

/// From here on SIGINT, SIGTERM and SIGHUP raise `interrupt_flag()` instead of ending the process;
/// a second one ends it at once with exit code 130. Other signals that end a process, and
/// std::terminate and abort (exit code 4), end it after removing the paths of RemovedOnExit, too.
/// Signals that the parent chose to ignore stay ignored. A closed pipe and a file limit become
/// errors of write() instead of signals.
void catch_signals();

/// True once a signal asked to stop.
const std::atomic<bool>& interrupt_flag();

/// While it lives, signals wait. For the few system calls that put a result in place.
class SignalsWait {
 public:
  SignalsWait();
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_;
};

}  // namespace clackers::cli
