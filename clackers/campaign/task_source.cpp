#include "clackers/campaign/task_source.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/base/number.hpp"

namespace clackers::campaign {
TaskSet::TaskSet(std::vector<TaskBlock> blocks) {
  std::ranges::sort(blocks, {}, &TaskBlock::first);
  for (const auto& block : blocks) {
    if (block.size() <= 0) continue;
    if (blocks_.empty() || block.first > blocks_.back().last)
      blocks_.push_back(block);
    else
      blocks_.back().last = std::max(blocks_.back().last, block.last);
  }
}

void TaskSet::append(long long task) {
  if (blocks_.empty() || task > blocks_.back().last)
    blocks_.push_back({task, task + 1});
  else
    blocks_.back().last = std::max(blocks_.back().last, task + 1);
}

bool TaskSet::contains(long long task) const {
  const auto after = std::ranges::upper_bound(blocks_, task, {}, &TaskBlock::first);
  return after != blocks_.begin() && task < std::prev(after)->last;
}

long long TaskSet::size() const {
  long long count = 0;
  for (const auto& block : blocks_) count += block.size();
  return count;
}

Shard shard_from(std::string_view text) {
  const auto slash = text.find('/');
  const Shard shard{whole_number(text.substr(0, slash)).value_or(0),
                    slash == text.npos ? 0 : whole_number(text.substr(slash + 1)).value_or(0)};
  if (!(shard.index >= 1 && shard.index <= shard.count && shard.count <= most_shards))
    refuse("campaign", "shard", text, "i/n with 1 <= i <= n <= 1e6",
           "3/16 is the third of sixteen parts.");
  return shard;
}

long long tasks_of_shard(long long tasks, long long block, const Shard& shard) {
  const auto blocks = (tasks + block - 1) / block;
  const auto mine = (blocks - shard.index + shard.count) / shard.count;
  const bool has_last = blocks > 0 && (blocks - 1) % shard.count == shard.index - 1;
  return mine * block - (has_last ? blocks * block - tasks : 0);
}

LocalTasks::LocalTasks(long long tasks, TaskSet finished, long long block, Shard shard)
    : tasks_(tasks), block_(std::max(1LL, block)), finished_(std::move(finished)), shard_(shard) {
  at_ = (shard_.index - 1) * block_;
  // A shard's database holds tasks of its own alone.
  remaining_ = tasks_of_shard(tasks_, block_, shard_) - finished_.size();
}

std::optional<TaskBlock> LocalTasks::next() {
  const std::lock_guard lock(guard_);
  const auto finished = finished_.blocks();
  while (at_ < tasks_) {
    while (interval_ < finished.size() && finished[interval_].last <= at_) ++interval_;
    const auto number = at_ / block_;
    const auto mine = number - number % shard_.count + shard_.index - 1;
    if (number != mine) {
      at_ = (mine > number ? mine : mine + shard_.count) * block_;
      continue;
    }
    const bool has_finished = interval_ < finished.size();
    if (has_finished && finished[interval_].first <= at_) {
      at_ = finished[interval_].last;
      continue;
    }
    auto last = std::min(tasks_, (number + 1) * block_);
    if (has_finished) last = std::min(last, finished[interval_].first);
    return TaskBlock{std::exchange(at_, last), last};
  }
  return {};
}

long long block_size(const Specification& specification, long long workers) {
  constexpr long long blocks_a_worker = 8;
  const auto methods = static_cast<long long>(specification.methods().size());
  return specification.systems() >= blocks_a_worker * workers ? methods : 1;
}

}  // namespace clackers::campaign
