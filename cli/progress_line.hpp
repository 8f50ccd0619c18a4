#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace clackers::cli {

/// One line on a terminal's standard error that tells how far the work is, rewritten in place and
/// erased at the end. Silent when standard error is no terminal.
class ProgressLine {
 public:
  /// `what` stands first: "verify".
  ProgressLine(std::string what, bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// The share of the work that is done, in [0, 1]; from any thread.
  void tell(double share);

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  bool visible_;
  std::mutex mutex_;
  Clock::time_point start_, last_{};
};

/// "12 s", "3 min 05 s", "2 h 07 min".
std::string spell_duration(double seconds);

}  // namespace clackers::cli
