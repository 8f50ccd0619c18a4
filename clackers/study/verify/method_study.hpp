#pragma once

#include <map>
#include <span>
#include <vector>

#include "clackers/study/refinement.hpp"
#include "clackers/study/verify/assessed_run.hpp"

namespace clackers::study {

/// One method on one case: its ladder, which refinement may change, and what was run of it. The
/// plan must outlive it.
class MethodStudy {
 public:
  MethodStudy(const CasePlan& plan, std::size_t method);

  const CasePlan& plan() const { return *plan_; }
  const record::Subject& subject() const { return subject_; }

  /// The runs that a ladder needs and that were not made yet, longest first. A level that is the
  /// finest one whose first run metrics can be measured on has them measured.
  std::vector<RunTask> missing(const record::RefinementPlan& steps) const;
  /// Processor time of these runs by that of a step of the finest runs so far [s].
  double expected_seconds(std::span<const RunTask> tasks) const;
  void take(const RunTask& task, AssessedRun run);

  /// Makes `steps` the ladder and assesses it; a level that lacks a run is left out, and the subject
  /// is incomplete.
  void assess(const record::RefinementPlan& steps);
  /// next_plan() of the subject; none for tolerances.
  NextPlan next() const;
  /// Ends refinement; `next_seconds` is what did not fit into the budget.
  void close(record::RefinementEnd end, double next_seconds = 0.0);
  bool is_closed() const { return is_closed_; }

  /// The subject with what runs with steps say without the reference solution; `exact` are the reference
  /// displacements at the end over the largest envelopes. The runs are moved from.
  record::Subject finish(std::span<const double> exact);

 private:
  const CasePlan* plan_;
  std::size_t method_;
  record::RefinementPlan steps_;
  std::map<long long, AssessedRun> runs_;  // by number of steps
  record::Subject subject_;
  bool is_closed_ = false;
};

}  // namespace clackers::study
