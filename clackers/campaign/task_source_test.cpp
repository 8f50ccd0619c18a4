#include "clackers/campaign/task_source.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "clackers/base/testing/refusal.hpp"

namespace clackers::campaign {
namespace {

std::vector<long long> tasks_of(TaskSource& source) {
  std::vector<long long> tasks;
  while (const auto block = source.next())
    for (auto task = block->first; task < block->last; ++task) tasks.push_back(task);
  return tasks;
}

TEST(TaskSet, JoinsNeighboursAndOverlaps) {
  const TaskSet set({{7, 9}, {0, 2}, {2, 3}, {8, 12}, {5, 5}});
  ASSERT_EQ(set.blocks().size(), 2u);
  EXPECT_EQ(set.blocks()[0], (TaskBlock{0, 3}));
  EXPECT_EQ(set.blocks()[1], (TaskBlock{7, 12}));
  EXPECT_EQ(set.size(), 8);
  for (const long long task : {0, 2, 7, 11}) EXPECT_TRUE(set.contains(task));
  for (const long long task : {3, 6, 12}) EXPECT_FALSE(set.contains(task));
}

TEST(TaskSet, AppendsInOrder) {
  TaskSet set;
  for (const long long task : {0, 1, 1, 4}) set.append(task);
  EXPECT_EQ(set.size(), 3);
  EXPECT_EQ(set.blocks().size(), 2u);
}

TEST(LocalTasks, ShardsHaveEachUnfinishedTaskOnce) {
  std::mt19937 random(20);
  for (int trial = 0; trial < 200; ++trial) {
    const long long tasks = 1 + long(random() % 60), block = 1 + long(random() % 9);
    const long long shards = 1 + long(random() % 5);
    TaskSet finished;
    std::vector<long long> expected, found;
    for (long long task = 0; task < tasks; ++task)
      if (random() % 3 == 0)
        finished.append(task);
      else
        expected.push_back(task);
    for (long long i = 1; i <= shards; ++i) {
      LocalTasks whole(tasks, {}, block, {i, shards});
      const auto all = static_cast<long long>(tasks_of(whole).size());
      EXPECT_EQ(tasks_of_shard(tasks, block, {i, shards}), all);
      EXPECT_EQ(whole.remaining(), all);
      LocalTasks source(tasks, finished, block, {i, shards});
      for (const auto task : tasks_of(source)) {
        EXPECT_EQ(task / block % shards, i - 1);
        found.push_back(task);
      }
    }
    std::ranges::sort(found);
    EXPECT_EQ(found, expected) << "trial " << trial;
  }
}

TEST(LocalTasks, LeapsOverWhatIsFinished) {
  LocalTasks source(1000000000000, TaskSet({{0, 999999999999}}), 10);
  EXPECT_EQ(source.remaining(), 1);
  EXPECT_EQ(source.next(), (TaskBlock{999999999999, 1000000000000}));
  EXPECT_FALSE(source.next());
}

TEST(Shard, IsReadFromTwoNumbers) {
  EXPECT_EQ(shard_from("3/16").index, 3);
  EXPECT_EQ(shard_from("3/16").count, 16);
  for (const auto* text : {"0/3", "4/3", "3", "a/b", "1/2/3", "/", "", "1/0", "-1/2", "1/10000000"})
    EXPECT_REFUSED(shard_from(text), "out-of-range", "i/n");
}

}  // namespace
}  // namespace clackers::campaign
