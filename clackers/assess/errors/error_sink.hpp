#pragma once

#include <atomic>
#include <limits>
#include <vector>

#include "clackers/assess/errors/error_history.hpp"
#include "clackers/assess/errors/mechanical_energy.hpp"
#include "clackers/assess/errors/score.hpp"
#include "clackers/assess/errors/velocity_error.hpp"
#include "clackers/assess/impacts/impact_matcher.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/model/run.hpp"
#include "clackers/model/sink.hpp"

namespace clackers::assess {

/// What an ErrorSink may do beside measuring.
struct ErrorSinkOptions {
  bool impacts_are_reported = true;          ///< false: the score has no impacts
  int history_bins = 0;                      ///< of the error history, 0 for none
  const std::atomic<bool>* abort = nullptr;  ///< ends the run when it becomes true
};

/// Judges one run while it happens: takes its states and impacts, asks the true motion for the
/// same times a block at a time, and keeps sums and maxima alone. The energy is that of the
/// problem's mass and stiffness, v' M v / 2 + u' K u / 2.
class ErrorSink : public model::Sink {
 public:
  /// Motion and problem must outlive the sink. Throws InputError unless both have the same number
  /// of masses, every mass has a positive envelope of u and v at t = 0, the true energy at the
  /// start is positive, and 0 < step < infinity [s].
  ErrorSink(const model::Motion& reference, const model::ImpactProblem<>& problem, double step,
            const ErrorSinkOptions& options = {});

  bool take(const model::SampleBlock& block) override;
  bool take(const model::ReportedImpact& impact) override;

  /// The score so far; how the run ended and what it cost come from `outcome`. A state that was not
  /// finite makes the errors infinite. `seconds` is left 0.
  RunScore score(const model::Outcome& outcome) const;
  /// |error in u| over the initial envelope against time.
  const ErrorHistory& history() const { return history_; }

 private:
  void take_part(const model::SampleBlock& block, std::size_t from, std::size_t count);
  void sample_reference(std::span<const double> times);
  bool goes_on() const {
    return options_.abort == nullptr || !options_.abort->load(std::memory_order_relaxed);
  }

  const model::Motion& reference_;
  std::size_t dof_;
  double step_;
  ErrorSinkOptions options_;
  std::vector<model::Contact<>> contacts_;
  MechanicalEnergy energy_;
  std::vector<double> u_envelope_, v_envelope_;  ///< at t = 0
  double start_, first_energy_;
  std::vector<double> times_, u_true_, v_true_, relative_;  ///< of one block
  double u_error_ = 0.0, u_absolute_ = 0.0, energy_error_ = 0.0;
  double energy_ratio_ = std::numeric_limits<double>::quiet_NaN();
  double last_ = 0.0;  ///< time of the last state
  long long states_ = 0;
  bool finite_ = true;  ///< every state so far was
  VelocityError velocity_;
  ImpactMatcher impacts_;
  ErrorHistory history_;
};

}  // namespace clackers::assess
