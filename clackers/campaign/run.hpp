#pragma once

#include <atomic>
#include <functional>

#include "clackers/campaign/specification.hpp"
#include "clackers/campaign/store.hpp"
#include "clackers/campaign/task_source.hpp"

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

}  // namespace clackers::campaign
