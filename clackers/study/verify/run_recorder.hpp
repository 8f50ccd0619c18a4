#pragma once

#include <vector>

#include "clackers/model/sink.hpp"

namespace clackers::study {

/// Passes a run on to its judge and, where there is one, to a store; keeps the last displacements.
class RunRecorder : public model::Sink {
 public:
  /// `store` may be null; both must outlive the recorder.
  RunRecorder(model::Sink& judge, model::Sink* store) : judge_(judge), store_(store) {}

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
  template <class Item>
  bool pass(const Item& item) {
    return (store_ == nullptr || store_->take(item)) && judge_.take(item);
  }

  model::Sink& judge_;
  model::Sink* store_;
  std::vector<double> last_u_;
};

}  // namespace clackers::study
