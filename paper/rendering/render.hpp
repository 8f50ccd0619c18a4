#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "clackers/base/codes.hpp"

namespace clackers::paper {

/// How a program ended.
struct Ended {
  int code = 0;          ///< exit code; 128 + number for a signal
  std::string messages;  ///< what it wrote to standard error
};

/// Runs `arguments.front()`, looked up on the PATH, without input and output. It is killed when `interrupt` becomes true and after `limit`.
/// Nothing when there is no such program. Throws FileError when no process can be started.
std::optional<Ended> run_program(const std::vector<std::string>& arguments,
                                 const std::atomic<bool>* interrupt = nullptr,
                                 std::chrono::seconds limit = std::chrono::minutes(10));

/// Why some pictures are missing.
struct Missing {
  std::string sentence;  ///< what failed, what to install, what was written all the same
  Code code;             ///< no-renderer or render-failed
};

/// Draws each NAME.vl.json of `folder` as NAME.svg (node) and NAME.pdf (rsvg-convert). Nothing
/// else stays behind in the folder. Returns what could not be drawn; empty when all could.
std::vector<Missing> render(const std::filesystem::path& folder,
                            const std::vector<std::string>& names,
                            const std::atomic<bool>* interrupt = nullptr);

}  // namespace clackers::paper
