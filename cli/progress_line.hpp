#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

namespace clackers::cli {

/// One line on a terminal's standard error with the share of the work that is done, rewritten in
/// place and erased at the end. Silent when standard error is no terminal.
class ProgressLine {
 public:
  /// `what` stands first: "verify".
  ProgressLine(std::string what, bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// The share of the work that is done, in [0, 1]; from any thread. A smaller one than before
  /// begins a new round, with its own time.
  void report(double share);
  /// The same with what was done so far and its rate: "12,000 runs, 850/s".
  void report(double share, long long done, std::string_view unit);
  /// report() for functions that take a callback; valid as long as this object.
  std::function<void(double)> callback() {
    return [this](double share) { report(share); };
  }

 private:
  using Clock = std::chrono::steady_clock;

  void show(double share, const std::function<std::string(double elapsed)>& detail);

  std::string what_;
  bool visible_;
  std::mutex mutex_;
  Clock::time_point start_, last_{};
  double share_ = 0.0;
};

/// "12 s", "3 min 05 s", "2 h 07 min".
std::string duration_text(double seconds);

}  // namespace clackers::cli
