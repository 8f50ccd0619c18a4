#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "clackers/campaign/task_source.hpp"

namespace clackers::campaign {

/// The tasks of [0, tasks) that are not in the set.
std::vector<TaskBlock> unfinished_tasks(const TaskSet& finished, long long tasks);

/// How long the blocks of a Dispatcher are.
struct BlockPlan {
  int ranks = 1;               ///< that share the tasks, >= 1
  long long grain = 1;         ///< tasks of one system, which are best kept together, >= 1
  double block_seconds = 0.1;  ///< what a block should take a rank [s], > 0
};

/// The time of a block with so many ranks: at most a thousand of them ask for one in a second.
double block_seconds(int ranks);

/// Gives out tasks in blocks, each once, in ascending order; from any thread. It knows numbers of
/// tasks only.
///
/// A rank's first block has `grain` tasks. Each later one is as long as its last block's time
/// suggests for `block_seconds`, but at most eight times as long as the last, and at most the share
/// (tasks left) / (2 ranks), so that blocks shrink towards the end. Blocks above `grain` end at a
/// multiple of it.
class Dispatcher {
 public:
  /// `unfinished` ascends without overlap.
  Dispatcher(std::vector<TaskBlock> unfinished, const BlockPlan& plan);

  /// The next block for a rank in [0, ranks) that asks at time `now` [s, any origin] because it has
  /// finished its last one. Nothing when all tasks were given out.
  std::optional<TaskBlock> take(int rank, double now);

  /// No block is given out any more.
  void stop();
  /// Tasks that were not given out.
  long long left() const;
  /// Tasks of the blocks whose ranks asked again.
  long long finished() const;

 private:
  struct Rank {
    long long tasks = 0;  ///< of its last block
    double since = 0.0;   ///< when it got that block [s]
  };

  long long length_for(const Rank& rank, double now) const;
  TaskBlock cut(long long length);

  mutable std::mutex mutex_;
  std::vector<TaskBlock> unfinished_;
  BlockPlan plan_;
  std::vector<Rank> ranks_;
  std::size_t at_ = 0;
  long long left_ = 0, finished_ = 0;
};

}  // namespace clackers::campaign
