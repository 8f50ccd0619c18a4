#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "clackers/base/jobs/progress.hpp"
#include "clackers/model/sink.hpp"

namespace clackers::study {

/// Passes a run on to its error sink and, where there is one, to a store; keeps the last
/// displacements.
class RunRecorder : public model::Sink {
 public:
  /// `store` may be null; both must outlive the recorder.
  RunRecorder(model::Sink& errors, model::Sink* store) : errors_(errors), store_(store) {}

  bool take(const model::SampleBlock& block) override {
    if (!block.t.empty()) {
      const auto last = block.u.last(static_cast<std::size_t>(block.dof));
      last_u_.assign(last.begin(), last.end());
    }
    return pass(block);
  }
  bool take(const model::ReportedImpact& impact) override { return pass(impact); }

  /// Of the last state [m], one entry a mass; empty before the first.
  const std::vector<double>& last_u() const { return last_u_; }

 private:
  bool pass(const auto& item) {
    return (store_ == nullptr || store_->take(item)) && errors_.take(item);
  }

  model::Sink& errors_;
  model::Sink* store_;
  std::vector<double> last_u_;
};

/// Passes a run on to another sink, counts its states as progress, and ends it when the user
/// interrupts.
class WatchedSink : public model::Sink {
 public:
  /// `to` and `interrupt` may be null; all must outlive the sink. A state counts `state_cost`.
  WatchedSink(model::Sink* to, TaskShare& share, double state_cost,
              const std::atomic<bool>* interrupt)
      : to_(to), share_(share), state_cost_(state_cost), interrupt_(interrupt) {}

  bool take(const model::SampleBlock& block) override {
    // Threads share the meter's lock: it is taken too rarely to be seen in the time of a run.
    pending_ += block.t.size();
    if (pending_ >= portion) {
      share_.add(state_cost_ * double(pending_));
      pending_ = 0;
    }
    if (is_interrupted()) return false;
    return to_ == nullptr || to_->take(block);
  }
  bool take(const model::ReportedImpact& impact) override {
    return to_ == nullptr || to_->take(impact);
  }

  static constexpr std::size_t portion = 16384;  ///< states reported at once

 private:
  bool is_interrupted() const {
    return interrupt_ != nullptr && interrupt_->load(std::memory_order_relaxed);
  }

  model::Sink* to_;
  TaskShare& share_;
  double state_cost_;
  const std::atomic<bool>* interrupt_;
  std::size_t pending_ = 0;
};

}  // namespace clackers::study
