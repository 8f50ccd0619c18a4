#include "clackers/campaign/run.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "clackers/base/jobs/work_queue.hpp"

namespace clackers::campaign {
namespace {

using Clock = std::chrono::steady_clock;

// A transaction costs some milliseconds; what is lost when the process is killed is one interval.
constexpr auto store_interval = std::chrono::milliseconds(500);
constexpr auto poll_interval = std::chrono::milliseconds(50);
// Rows that wait for the writer, in tasks; workers wait beyond.
constexpr std::size_t most_waiting = 100000;

// Tasks on their way from the workers to the writer.
class Finished {
 public:
  void put(TaskRows rows) {
    std::unique_lock lock(guard_);
    room_.wait(lock, [&] { return rows_.size() < most_waiting || stop; });
    rows_.push_back(std::move(rows));
  }
  void end() {
    const std::lock_guard lock(guard_);
    ended_ = true;
    done_.notify_one();
  }
  /// Waits an interval or until all workers ended; true when they did.
  bool wait() {
    std::unique_lock lock(guard_);
    return done_.wait_for(lock, poll_interval, [&] { return ended_; });
  }
  std::vector<TaskRows> take() {
    const std::lock_guard lock(guard_);
    room_.notify_all();
    return std::exchange(rows_, {});
  }
  void stop_all() {
    stop = true;
    room_.notify_all();
  }

  std::atomic<bool> stop{false};

 private:
  std::mutex guard_;
  std::condition_variable done_, room_;
  std::vector<TaskRows> rows_;
  bool ended_ = false;
};

}  // namespace

RunSummary run_campaign(const Specification& specification, Store& store, TaskSource& source,
                        const RunOptions& options, const std::atomic<bool>* interrupt) {
  const auto workers = static_cast<std::size_t>(thread_count(options.jobs));
  const auto solvers = solvers_of(specification);
  Finished finished;
  std::exception_ptr failure;
  const auto serve = [&] {
    TaskRunner runner(specification, solvers);
    while (!finished.stop) {
      const auto block = source.next();
      if (!block) return;
      for (auto task = block->first; task < block->last && !finished.stop; ++task)
        if (auto rows = runner.run(task, &finished.stop)) finished.put(std::move(*rows));
    }
  };
  std::jthread crew([&] {
    try {
      run_all(workers, static_cast<int>(workers), [&](std::size_t) {
        try {
          serve();
        } catch (...) {
          finished.stop_all();
          throw;
        }
      });
    } catch (...) {
      failure = std::current_exception();
    }
    finished.end();
  });
  RunSummary summary;
  auto last = Clock::now();
  try {
    for (bool ended = false; !ended;) {
      ended = finished.wait();
      if (interrupt != nullptr && *interrupt) {
        summary.interrupted = true;
        finished.stop_all();
      }
      if (!ended && Clock::now() - last < store_interval) continue;
      const auto rows = finished.take();
      if (!rows.empty()) store.write(rows);
      summary.tasks += static_cast<long long>(rows.size());
      for (const auto& task : rows) summary.runs += static_cast<long long>(task.runs.size());
      if (options.progress) options.progress(summary);
      last = Clock::now();
    }
  } catch (...) {
    finished.stop_all();
    throw;
  }
  crew.join();
  if (failure) std::rethrow_exception(failure);
  return summary;
}

}  // namespace clackers::campaign
