#include "clackers/base/jobs/progress.hpp"

#include <algorithm>
#include <utility>

namespace clackers {

ProgressMeter::ProgressMeter(double total, Progress progress)
    : total_(total), progress_(std::move(progress)) {}

void ProgressMeter::add(double amount) {
  if (!progress_) return;
  const std::lock_guard lock(guard_);
  done_ += amount;
  const auto now = Clock::now();
  if (now - last_ < std::chrono::milliseconds(50)) return;
  last_ = now;
  // The sum of many shares can pass the total by rounding.
  progress_(std::min(1.0, done_ / total_));
}

void ProgressMeter::finish() {
  if (!progress_) return;
  const std::lock_guard lock(guard_);
  progress_(1.0);
}

void TaskShare::add(double amount) {
  const double part = std::min(amount, left_);
  left_ -= part;
  meter_.add(part);
}

}  // namespace clackers
