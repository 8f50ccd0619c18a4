#pragma once

#include <atomic>
#include <string>

namespace clackers::solvers {

/// A shell command to run.
struct ProcessTask {
  std::string command;    ///< for /bin/sh -c
  std::string folder;     ///< where it runs
  double timeout = 60.0;  ///< [s], of the wall clock
  std::string output{};   ///< file for its standard output; empty: part of what it printed
  std::size_t most_output = std::size_t{1} << 30;  ///< that the file may have [bytes]
  bool removes_folder = false;  ///< where we are killed, the folder goes with the program
};

/// How a process ended, and what it printed.
struct ProcessResult {
  enum class End {
    exited,       ///< `status` is its exit status
    signalled,    ///< `status` is the signal that ended it
    timed_out,    ///< killed after the timeout
    interrupted,  ///< killed since `interrupt` became true
    flooded,      ///< killed after `most_output` bytes for the file of its standard output
    not_started   ///< `status` is the system's error number
  };
  End end = End::exited;
  int status = 0;
  double seconds = 0.0;  ///< user time of the program and of what it started [s]
  std::string printed;   ///< the last `most_printed` bytes of standard error and, unless it went to
                         ///< a file, of standard output
};

inline constexpr std::size_t most_printed = 4096;  // [bytes]

/// Runs a command with /dev/null as standard input, no file of ours open, and the folder that we run
/// in as OLDPWD, and ends all processes that it started, as ProcessTree does. May be called from
/// several threads.
ProcessResult run_process(const ProcessTask& task, const std::atomic<bool>* interrupt = nullptr);

}  // namespace clackers::solvers
