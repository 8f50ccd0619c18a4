#include "clackers/campaign/ranks/dispatcher.hpp"

#include <algorithm>
#include <utility>

namespace clackers::campaign {
namespace {

constexpr long long largest_growth = 8;
constexpr double requests_per_second = 1000.0;

}  // namespace

double block_seconds(int ranks) { return std::max(0.1, ranks / requests_per_second); }

std::vector<TaskBlock> unfinished_tasks(const TaskSet& finished, long long tasks) {
  std::vector<TaskBlock> unfinished;
  long long at = 0;
  for (const auto& block : finished.blocks()) {
    if (at < block.first) unfinished.push_back({at, block.first});
    at = block.last;
  }
  if (at < tasks) unfinished.push_back({at, tasks});
  return unfinished;
}

Dispatcher::Dispatcher(std::vector<TaskBlock> unfinished, const BlockPlan& plan)
    : unfinished_(std::move(unfinished)),
      plan_(plan),
      ranks_(static_cast<std::size_t>(plan.ranks)) {
  std::erase_if(unfinished_, [](const auto& block) { return block.size() == 0; });
  for (const auto& block : unfinished_) left_ += block.size();
}

std::optional<TaskBlock> Dispatcher::take(int rank, double now) {
  const std::lock_guard lock(mutex_);
  auto& asking = ranks_.at(static_cast<std::size_t>(rank));
  finished_ += asking.tasks;
  if (left_ == 0) {
    asking.tasks = 0;
    return std::nullopt;
  }
  const auto block = cut(length_for(asking, now));
  asking = {block.size(), now};
  left_ -= asking.tasks;
  return block;
}

long long Dispatcher::length_for(const Rank& rank, double now) const {
  const auto share = left_ / (2 * plan_.ranks);
  if (rank.tasks == 0) return std::clamp<long long>(share, 1, plan_.grain);
  const auto longest = rank.tasks * largest_growth;
  const auto scaled =
      static_cast<double>(rank.tasks) * plan_.block_seconds / std::max(now - rank.since, 1e-9);
  const auto timed =
      scaled < static_cast<double>(longest) ? static_cast<long long>(scaled) : longest;
  return std::max<long long>(1, std::min(timed, share));
}

TaskBlock Dispatcher::cut(long long length) {
  auto& interval = unfinished_[at_];
  auto last = interval.first + std::min(length, interval.size());
  if (length > plan_.grain && last < interval.last) last -= last % plan_.grain;
  const TaskBlock block{interval.first, last};
  interval.first = last;
  if (interval.size() == 0) ++at_;
  return block;
}

void Dispatcher::stop() {
  const std::lock_guard lock(mutex_);
  at_ = unfinished_.size();
  left_ = 0;
}

long long Dispatcher::left() const {
  const std::lock_guard lock(mutex_);
  return left_;
}

long long Dispatcher::finished() const {
  const std::lock_guard lock(mutex_);
  return finished_;
}

}  // namespace clackers::campaign
