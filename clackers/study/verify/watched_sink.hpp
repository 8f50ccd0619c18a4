#pragma once

#include <atomic>
#include <cstddef>

#include "clackers/model/sink.hpp"
#include "clackers/study/verify/progress_meter.hpp"

namespace clackers::study {

/// Passes a run on to another sink, counts its states as progress, and ends it when the user
/// interrupts. Without another sink the run is only watched.
class WatchedSink : public model::Sink {
 public:
  /// `to` and `interrupt` may be null; all must outlive the sink. A state counts `state_cost`.
  WatchedSink(model::Sink* to, TaskShare& share, double state_cost,
              const std::atomic<bool>* interrupt)
      : to_(to), share_(share), state_cost_(state_cost), interrupt_(interrupt) {}

  bool take(const model::SampleBlock& block) override {
    // Threads meet in the meter: rarely enough not to be seen in the time of a run.
    untold_ += block.t.size();
    if (untold_ >= told_at_once) {
      share_.add(state_cost_ * double(untold_));
      untold_ = 0;
    }
    if (is_interrupted()) return false;
    return to_ == nullptr || to_->take(block);
  }
  bool take(const model::ReportedImpact& impact) override {
    return to_ == nullptr || to_->take(impact);
  }

  static constexpr std::size_t told_at_once = 16384;  ///< states

 private:
  bool is_interrupted() const {
    return interrupt_ != nullptr && interrupt_->load(std::memory_order_relaxed);
  }

  model::Sink* to_;
  TaskShare& share_;
  double state_cost_;
  const std::atomic<bool>* interrupt_;
  std::size_t untold_ = 0;
};

}  // namespace clackers::study
