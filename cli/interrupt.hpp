#pragma once

#include <atomic>
#include <exception>
#include <string>

namespace clackers::cli {

/// Thrown where work stops because a signal asked for it. Exit code 130 of the command.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// From here on SIGINT, SIGTERM and SIGHUP raise `interrupt_flag()` instead of ending the process;
/// a second one ends it at once with exit code 130, after removing the files of RemovedOnExit.
/// Signals that the parent chose to ignore stay ignored. A closed pipe and a file limit become
/// errors of write() instead of signals.
void catch_signals();

/// True once a signal asked to stop.
const std::atomic<bool>& interrupt_flag();

/// While it lives, the file is removed when a second signal ends the process.
class RemovedOnExit {
 public:
  explicit RemovedOnExit(std::string path);
  ~RemovedOnExit();
  RemovedOnExit(const RemovedOnExit&) = delete;
  RemovedOnExit& operator=(const RemovedOnExit&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace clackers::cli
