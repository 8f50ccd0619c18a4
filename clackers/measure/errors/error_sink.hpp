#pragma once

#include <limits>
#include <vector>

#include "clackers/measure/errors/error_history.hpp"
#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/measure/errors/score.hpp"
#include "clackers/measure/errors/velocity_error.hpp"
#include "clackers/measure/impacts/impact_matcher.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/model/run.hpp"
#include "clackers/model/sink.hpp"

namespace clackers::measure {

/// Options of an ErrorSink.
struct ErrorSinkOptions {
  bool impacts_are_reported = true;  ///< false: the score has no impacts
  int history_bins = 0;              ///< of the error history, 0 for none
};

/// Measures one run while it happens: takes its states and impacts, samples the reference at the
/// same times in blocks, and keeps sums and maxima alone. The energy is that of the problem's mass
/// and stiffness, v' M v / 2 + u' K u / 2.
class ErrorSink : public model::Sink {
 public:
  /// Motion and problem must outlive the sink. Throws InputError unless both have the same number
  /// of masses, every mass has a positive peak() of u and v, the reference has energy at
  /// some time, and 0 < step < infinity [s].
  ErrorSink(const model::Motion& reference, const model::ImpactProblem<>& problem, double step,
            const ErrorSinkOptions& options = {});

  bool take(const model::SampleBlock& block) override;
  bool take(const model::ReportedImpact& impact) override;

  /// The score so far; how the run ended and what it cost come from `outcome`. A state that was not
  /// finite makes the errors infinite. `seconds` is left 0.
  RunScore score(const model::Outcome& outcome) const;
  /// |error in u| over its scale against time.
  const ErrorHistory& history() const { return history_; }

 private:
  void take_part(const model::SampleBlock& block, std::size_t from, std::size_t count);
  void sample_reference(std::span<const double> times);

  const model::Motion& reference_;
  std::size_t dof_;
  double step_;
  ErrorSinkOptions options_;
  std::vector<model::Contact<>> contacts_;
  MechanicalEnergy energy_;
  model::Kinematics scale_;
  double start_, energy_scale_;
  std::vector<double> times_, u_reference_, v_reference_, relative_;  ///< of one block
  std::vector<double> u_error_;                                       ///< largest of each mass [m]
  double energy_error_ = 0.0;
  double energy_ratio_ = std::numeric_limits<double>::quiet_NaN();
  double bound_ = 0.0;  ///< largest relative_bound() of the reference
  double last_;         ///< time of the last state
  long long states_ = 0;
  double finite_ = 0.0;  ///< 0 while every state is finite, then NaN
  VelocityError velocity_;
  ImpactMatcher impacts_;
  ErrorHistory history_;
};

}  // namespace clackers::measure
