#pragma once

#include <sys/types.h>

#include "clackers/base/files/files.hpp"
#include "clackers/solvers/process.hpp"

namespace clackers::solvers {

/// A pipe whose end for reading does not wait.
struct Pipe {
  Descriptor read, write;
  /// False with errno.
  bool make();
};

/// A program with all processes that it starts, whatever they do. Between us and the program stands
/// a process of ours, the supervisor, to which the kernel gives processes whose parent has ended. It
/// ends all that is left after the program, when it is asked to, and when we end, also by SIGKILL.
class ProcessTree {
 public:
  ProcessTree() = default;
  ~ProcessTree();
  ProcessTree(const ProcessTree&) = delete;
  ProcessTree& operator=(const ProcessTree&) = delete;

  /// Its standard output and error go to `output` and `error`. 0 or the system's error number.
  int start(const ProcessTask& task, int output, int error);
  /// Whether none of its processes is left.
  bool has_ended() const;
  /// Ends all of its processes. How the program ended replaces `exited` in `result`.
  void end(ProcessResult& result);

 private:
  pid_t supervisor_ = 0;
  Pipe messages_;
};

/// Ends all processes of all trees; for a signal handler that ends the program.
void kill_processes() noexcept;

}  // namespace clackers::solvers
