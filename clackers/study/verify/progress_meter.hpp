#pragma once

#include <chrono>
#include <mutex>

#include "clackers/study/verify.hpp"

namespace clackers::study {

/// Adds up the work done by several threads and tells it on, one call at a time, the share never
/// falling and at most every 50 ms.
class ProgressMeter {
 public:
  /// `total` in any unit, > 0; an empty `progress` is told nothing.
  ProgressMeter(double total, Progress progress);

  /// From any thread: `amount` more was done.
  void add(double amount);
  /// Tells 1: all was done.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  double total_, done_ = 0.0;
  Progress progress_;
  Clock::time_point told_{};
  std::mutex guard_;
};

/// The share of one task in a meter: whatever happens to the task, its whole cost is added in the
/// end, and never more.
class TaskShare {
 public:
  TaskShare(ProgressMeter& meter, double cost) : meter_(meter), left_(cost) {}
  ~TaskShare() { add(left_); }
  TaskShare(const TaskShare&) = delete;
  TaskShare& operator=(const TaskShare&) = delete;

  void add(double amount);

 private:
  ProgressMeter& meter_;
  double left_;
};

}  // namespace clackers::study
