#pragma once

#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "clackers/campaign/specification.hpp"
#include "clackers/campaign/tasks.hpp"

// Which tasks are run here, in blocks.
namespace clackers::campaign {

/// A set of tasks as sorted blocks that neither touch nor overlap.
class TaskSet {
 public:
  TaskSet() = default;
  explicit TaskSet(std::vector<TaskBlock> blocks);  ///< in any order, may overlap

  /// Appends a task above all others, or one that is the last already.
  void append(long long task);
  bool contains(long long task) const;
  long long size() const;
  std::span<const TaskBlock> blocks() const { return blocks_; }

 private:
  std::vector<TaskBlock> blocks_;
};

/// One of several parts of a campaign: the blocks whose number is `index` modulo `count`.
struct Shard {
  long long index = 1, count = 1;  ///< index from 1

  bool is_all() const { return count == 1; }
};
inline constexpr long long most_shards = 1'000'000;
/// Reads "3/16". Throws InputError for anything else, and unless 1 <= index <= count <= most_shards.
Shard shard_from(std::string_view text);

/// How many of `tasks` in blocks of `block` are of a shard.
long long tasks_of_shard(long long tasks, long long block, const Shard& shard);

/// Deals tasks out to the workers of one process.
class TaskSource {
 public:
  virtual ~TaskSource() = default;
  /// The next block, none of its tasks finished; nothing after the last. From any thread.
  virtual std::optional<TaskBlock> next() = 0;
  /// How many tasks there were to run here, for progress; may be an estimate.
  virtual long long remaining() const = 0;
};

/// The unfinished tasks of a campaign or of one of its shards, in their order, in blocks of at most
/// `block` tasks.
class LocalTasks : public TaskSource {
 public:
  LocalTasks(long long tasks, TaskSet finished, long long block, Shard shard = {});

  std::optional<TaskBlock> next() override;
  long long remaining() const override { return remaining_; }

 private:
  long long tasks_, block_;
  TaskSet finished_;
  Shard shard_;
  long long remaining_ = 0;
  std::mutex guard_;
  long long at_ = 0;          // next task to look at
  std::size_t interval_ = 0;  // of finished_: the first that ends behind at_
};

/// Tasks in a block: the methods of one system, so that it is prepared once; one where a campaign has too
/// few systems to keep `workers` busy.
long long block_size(const Specification& specification, long long workers);

}  // namespace clackers::campaign
