#include "clackers/campaign/ranks/dispatcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace clackers::campaign {
namespace {

std::vector<TaskBlock> all_blocks(Dispatcher& dispatcher, double seconds_a_task, int ranks = 1) {
  std::vector<TaskBlock> blocks;
  std::vector<double> now(static_cast<std::size_t>(ranks), 0.0);
  for (int rank = 0;; rank = (rank + 1) % ranks) {
    auto& clock = now[static_cast<std::size_t>(rank)];
    const auto block = dispatcher.take(rank, clock);
    if (!block) return blocks;
    blocks.push_back(*block);
    clock += seconds_a_task * static_cast<double>(block->size());
  }
}

TEST(UnfinishedTasks, LieBetweenTheFinishedOnes) {
  const TaskSet finished({{2, 4}, {7, 9}});
  EXPECT_EQ(unfinished_tasks(finished, 10), (std::vector<TaskBlock>{{0, 2}, {4, 7}, {9, 10}}));
  EXPECT_EQ(unfinished_tasks(TaskSet({{0, 4}, {7, 10}}), 10), (std::vector<TaskBlock>{{4, 7}}));
  EXPECT_EQ(unfinished_tasks(TaskSet(), 3), (std::vector<TaskBlock>{{0, 3}}));
  EXPECT_TRUE(unfinished_tasks(TaskSet({{0, 3}}), 3).empty());
  EXPECT_TRUE(unfinished_tasks(TaskSet(), 0).empty());
}

TEST(Dispatcher, EveryTaskIsGivenOnceInAscendingOrder) {
  for (const int ranks : {1, 2, 7, 64})
    for (const long long grain : {1, 3, 10}) {
      Dispatcher dispatcher({{0, 5}, {6, 6}, {8, 1000}}, {.ranks = ranks, .grain = grain});
      std::vector<long long> given;
      for (const auto& block : all_blocks(dispatcher, 1e-3, ranks)) {
        ASSERT_GT(block.size(), 0);
        for (auto task = block.first; task < block.last; ++task) given.push_back(task);
      }
      ASSERT_EQ(given.size(), 5u + 992u);
      EXPECT_TRUE(std::ranges::is_sorted(given));
      EXPECT_EQ(std::ranges::adjacent_find(given), given.end());
      EXPECT_EQ(std::ranges::count_if(given, [](auto t) { return t >= 5 && t < 8; }), 0);
      EXPECT_EQ(dispatcher.left(), 0);
      for (int rank = 0; rank < ranks; ++rank) EXPECT_FALSE(dispatcher.take(rank, 1e3));
      EXPECT_EQ(dispatcher.finished(), 997);
    }
}

TEST(Dispatcher, FirstBlockHasTheTasksOfOneSystem) {
  Dispatcher dispatcher({{0, 1000}}, {.ranks = 4, .grain = 7});
  EXPECT_EQ(*dispatcher.take(2, 0.0), (TaskBlock{0, 7}));
}

TEST(Dispatcher, BlocksTakeTheTimeThatIsWanted) {
  Dispatcher dispatcher({{0, 1000000}}, {.ranks = 1, .grain = 10, .block_seconds = 0.5});
  const auto blocks = all_blocks(dispatcher, 1e-3);
  EXPECT_EQ(blocks[0].size(), 10);
  EXPECT_EQ(blocks[1].size(), 80);    // at most eight times the last
  EXPECT_EQ(blocks[2].last % 10, 0);  // whole systems
  EXPECT_EQ(blocks[2].size(), 500);
  EXPECT_EQ(blocks[3].size(), 500);
}

TEST(Dispatcher, SlowTasksMakeTheNextBlockShorter) {
  Dispatcher dispatcher({{0, 1000000}}, {.ranks = 1, .grain = 1, .block_seconds = 1.0});
  EXPECT_EQ(dispatcher.take(0, 0.0)->size(), 1);
  EXPECT_EQ(dispatcher.take(0, 0.001)->size(), 8);
  EXPECT_EQ(dispatcher.take(0, 0.002)->size(), 64);
  EXPECT_EQ(dispatcher.take(0, 64.002)->size(), 1);
}

TEST(Dispatcher, BlocksShrinkTowardsTheEnd) {
  constexpr int ranks = 8;
  Dispatcher dispatcher({{0, 100000}}, {.ranks = ranks, .grain = 5, .block_seconds = 1e9});
  long long left = 100000;
  for (const auto& block : all_blocks(dispatcher, 1e-9, ranks)) {
    EXPECT_LE(block.size(), std::max(left / (2 * ranks), 1ll));
    left -= block.size();
  }
}

TEST(Dispatcher, StoppedGivesNothing) {
  Dispatcher dispatcher({{0, 100}}, {.ranks = 2});
  EXPECT_TRUE(dispatcher.take(1, 0.0));
  dispatcher.stop();
  EXPECT_FALSE(dispatcher.take(0, 1.0));
  EXPECT_FALSE(dispatcher.take(1, 1.0));
}

TEST(BlockSeconds, AThousandRequestsASecondAtMost) {
  EXPECT_DOUBLE_EQ(block_seconds(2), 0.1);
  EXPECT_DOUBLE_EQ(block_seconds(10000), 10.0);
}

}  // namespace
}  // namespace clackers::campaign
