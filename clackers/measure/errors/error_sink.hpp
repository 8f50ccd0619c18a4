#pragma once

#include <vector>

#include "clackers/measure/errors/error_history.hpp"
#include "clackers/measure/errors/meter.hpp"
#include "clackers/measure/errors/score.hpp"
#include "clackers/measure/errors/shared_states.hpp"
#include "clackers/measure/impacts/impact_matcher.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/model/run.hpp"
#include "clackers/model/sink.hpp"

namespace clackers::measure {

/// Options of an ErrorSink.
struct ErrorSinkOptions {
  bool impacts_are_reported = true;  ///< false: the score has no impacts
  double contact_time = 0.0;         ///< of a compliant contact [s]
  int history_bins = 0;              ///< of the error history, 0 for none
  /// The reference at the times to expect; null: it is sampled.
  const GridStates* states = nullptr;
  long long steps = 0;  ///< equal steps of the run, the last of which ends at the end; 0: others
  const Scales* scales = nullptr;  ///< of the case, where they are known
};

/// Measures one run while it happens: takes its states and impacts, samples the reference at the
/// same times in blocks, and gives them to a Meter.
class ErrorSink : public model::Sink {
 public:
  /// Motion and problem must outlive the sink. Throws InputError unless both have the same number
  /// of masses, every mass has a positive peak() of u and v, the reference has energy at
  /// some time, and 0 < step < infinity [s].
  ErrorSink(const model::Motion& reference, const model::ImpactProblem<>& problem, double step,
            const ErrorSinkOptions& options = {});

  bool take(const model::SampleBlock& block) override;
  bool take(const model::ReportedImpact& impact) override;

  /// The score so far; how the run ended and what it cost come from `outcome`. `seconds` is left 0.
  RunScore score(const model::Outcome& outcome) const;
  /// |error in u| over its scale against time.
  const ErrorHistory& history() const { return history_; }

 private:
  void take_part(const model::SampleBlock& block, std::size_t from, std::size_t count);
  StateRows reference_at(std::span<const double> times);
  bool copy_ahead(std::span<const double> times);

  const model::Motion& reference_;
  std::size_t dof_;
  double start_, step_;
  ErrorSinkOptions options_;
  std::vector<model::Contact<>> contacts_;
  std::size_t taken_ = 0;
  GridStates ahead_;  ///< of a run of equal steps, those around the next state
  std::vector<double> times_, u_reference_, v_reference_, relative_;  ///< of one block
  Meter meter_;
  ImpactMatcher impacts_;
  ErrorHistory history_;
};

}  // namespace clackers::measure
