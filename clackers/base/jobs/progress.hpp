#pragma once

#include <chrono>
#include <functional>
#include <mutex>

namespace clackers {

/// The share of the work that is done, in [0, 1]. Called now and then, from any thread, one call at
/// a time. Where work comes in rounds, each begins at 0 again.
using Progress = std::function<void(double share)>;

/// Adds up the work done by several threads and reports it: calls are serialized, the share never
/// falls, and there is at most one call in 50 ms.
class ProgressMeter {
 public:
  /// `total` in any unit, > 0; `progress` may be empty.
  ProgressMeter(double total, Progress progress);

  /// From any thread: `amount` more was done.
  void add(double amount);
  /// Reports 1: all was done.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  double total_, done_ = 0.0;
  Progress progress_;
  Clock::time_point last_{};
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

}  // namespace clackers
