#pragma once

#include <atomic>
#include <functional>

#include "clackers/campaign/specification.hpp"
#include "clackers/campaign/store.hpp"
#include "clackers/campaign/task_source.hpp"
#include "clackers/record/sheet.hpp"

namespace clackers::campaign {

/// What a call of run_campaign() did.
struct RunSummary {
  long long tasks = 0, runs = 0;  ///< that were stored
  bool interrupted = false;
};

struct RunOptions {
  int jobs = 0;  ///< worker threads; 0: one per processor
  /// Called by the calling thread now and then with what was stored so far.
  std::function<void(const RunSummary&)> progress{};
};

/// Runs the tasks of a source on worker threads and stores their rows, many tasks a transaction, from
/// this thread. When `interrupt` becomes true what is finished is stored and the summary says so.
/// Rows do not depend on jobs, order or interruptions. Throws what a worker or the store throws, after
/// storing what was finished, if the store takes it.
RunSummary run_campaign(const Specification& specification, Store& store, TaskSource& source,
                        const RunOptions& options = {},
                        const std::atomic<bool>* interrupt = nullptr);

/// What a campaign takes. Runs, time and disk are estimates: of each case a few systems stand for all.
struct Plan {
  long long systems = 0, tasks = 0;
  double runs = 0.0;
  double seconds = 0.0;  ///< processor time [s]; 0 unless timed
  double bytes = 0.0;    ///< of the database
};

/// Of each case up to eight systems are prepared. With `timed` the shortest run of each method is made
/// on one of them, for ten seconds at most. Throws as solvers_of() does.
Plan plan_of(const Specification& specification, bool timed);

/// A quantity a row: what `clackers campaign plan` prints.
record::Sheet plan_sheet(const Plan& plan);

/// Runs beyond this are not started unasked.
inline constexpr double most_runs_unasked = 1e7;

/// Throws InputError (too-many-runs) with the estimate for a campaign of more runs.
void require_few_runs(const Specification& specification);

}  // namespace clackers::campaign
