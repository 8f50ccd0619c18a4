#pragma once

#include <atomic>
#include <optional>

#include "clackers/study/verify/progress_meter.hpp"
#include "clackers/study/verify/verify_plan.hpp"

namespace clackers::study {

/// One run of a study.
struct RunTask {
  std::size_t method = 0, level = 0, neighbour = 0;
  double step = 0.0;  ///< [s]
  long long steps = 0;
  int history_bins = 0;  ///< of the error against time, 0 for none
  bool metrics = false;  ///< measure all of them: the run is stored whole

  /// Work to expect, in judged states.
  double cost() const;
};

/// What a run left behind.
struct JudgedRun {
  assess::RunScore score;
  Curve history;  ///< empty without bins
  /// Displacements at the end over the initial envelopes; empty for a run that failed.
  std::vector<double> end_u;
  std::vector<MetricResult> metrics;  ///< empty where not asked for, and for a run that failed
};

/// Runs a method once under judgement and, if it finished, again without it for its processor time
/// (short runs several times, for a time that can be told from the clock's grain). Nothing when
/// interrupted.
std::optional<JudgedRun> judge_run(const VerifyPlan& plan, const RunTask& task, TaskShare& share,
                                   const std::atomic<bool>* interrupt);

}  // namespace clackers::study
