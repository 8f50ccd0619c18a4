#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "clackers/base/jobs/progress.hpp"
#include "clackers/study/verify/verify_plan.hpp"

namespace clackers::study {

/// One run of a study.
struct RunTask {
  std::size_t method = 0;  ///< index of the plan
  double step = 0.0;       ///< [s]; the tolerance of an adaptive method
  long long steps = 0;     ///< of an adaptive method those to expect
  int history_bins = 0;    ///< of the error against time, 0 for none
  bool metrics = false;    ///< measure all of them: the run is stored whole

  /// Work to expect, in states with errors. Only the progress shown depends on it.
  double cost() const;
};

/// A run and what self-convergence needs of it.
struct AssessedRun {
  record::Run run;
  /// Displacements at the end over the largest envelopes; empty for a run that failed.
  std::vector<double> end_u;
  double seconds = 0.0;  ///< processor time of the assessment [s]
};

/// Runs a method once with its errors measured and, if it finished, again without for its processor
/// time (short runs several times, for a time that the clock resolves), unless the plan's extras leave
/// that out: the time is then that of the run with its errors. Nothing when interrupted.
std::optional<AssessedRun> assess_run(const CasePlan& plan, const RunTask& task, TaskShare& share,
                                      const std::atomic<bool>* interrupt);

}  // namespace clackers::study
