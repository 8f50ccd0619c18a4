#pragma once

#include <string>
#include <vector>

namespace clackers::paper {

/// How a program ended.
struct Ended {
  bool found = true;     ///< false: no such program on the PATH
  int code = 0;          ///< exit code; 128 + number for a signal
  std::string messages;  ///< what it wrote to standard error
};

/// Runs `arguments.front()`, looked up on the PATH, with standard input and output closed to
/// /dev/null, and waits. Its standard error goes through the file `messages`. Throws FileError when
/// no process can be started.
Ended run_program(const std::vector<std::string>& arguments, const std::string& messages);

}  // namespace clackers::paper
