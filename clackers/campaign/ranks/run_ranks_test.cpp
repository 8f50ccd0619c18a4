#include "clackers/campaign/ranks/run_ranks.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/campaign/ranks/client.hpp"
#include "clackers/campaign/ranks/testing/local_ranks.hpp"
#include "clackers/campaign/testing/database_fixture.hpp"

namespace clackers::campaign {
namespace {

class Ranks : public test::DatabaseTest {
 protected:
  /// A campaign on so many ranks, which are threads.
  RanksSummary run(const std::string& name, int size) {
    test::LocalRanks ranks(size);
    std::vector<std::thread> others;
    for (int rank = 1; rank < size; ++rank)
      others.emplace_back([&, rank] { run_other_rank(ranks[rank], {.jobs = 1}, interrupt_); });
    auto store = Store::create_or_open(path(name), test::small());
    adopt_ranks(store);
    const auto summary = run_first_rank(ranks[0], test::small(), store, {.jobs = 1}, interrupt_,
                                        [&](long long done, long long all) {
                                          EXPECT_LE(done, all);
                                          all_ = all;
                                        });
    for (auto& other : others) other.join();
    return summary;
  }

  std::vector<std::vector<std::vector<record::Cell>>> expected() {
    run("one.db", 1);
    return rows("one.db");
  }

  std::atomic<bool> interrupt_ = false;
  long long all_ = -1;
};

TEST_F(Ranks, RowsDoNotDependOnTheirNumber) {
  const auto single = expected();
  ASSERT_EQ(single[0].size(), std::size_t(test::small().tasks()));
  for (const int size : {2, 5}) {
    const auto name = std::to_string(size) + ".db";
    const auto summary = run(name, size);
    EXPECT_EQ(summary.tasks, test::small().tasks());
    EXPECT_FALSE(summary.interrupted);
    EXPECT_TRUE(summary.failures.empty());
    EXPECT_EQ(all_, test::small().tasks());
    EXPECT_EQ(rows(name), single);
    EXPECT_TRUE(shard_files(path(name)).empty());
  }
}

TEST_F(Ranks, WhatLostRanksLeftIsNotComputedAgain) {
  const auto single = expected();
  {
    auto shard = Store::create_or_open(rank_path(path("a.db"), 9), test::small());
    LocalTasks first(test::small().tasks(), {}, 1, {1, 2});
    run_campaign(test::small(), shard, first, {.jobs = 1});
  }
  const auto summary = run("a.db", 3);
  EXPECT_EQ(summary.tasks, test::small().tasks() / 2);
  EXPECT_EQ(all_, test::small().tasks() / 2);
  EXPECT_EQ(rows("a.db"), single);
}

TEST_F(Ranks, TasksOfAFailedRankAreLeftForTheNextStart) {
  test::LocalRanks ranks(2);
  std::thread other([&] {
    Client client(ranks[1]);
    EXPECT_TRUE(client.greet());
    client.leave({}, client.next() ? "disk full" : "no block", "cannot-write");
  });
  {
    auto store = Store::create_or_open(path("a.db"), test::small());
    const auto summary = run_first_rank(ranks[0], test::small(), store, {.jobs = 1}, interrupt_);
    ASSERT_EQ(summary.failures.size(), 1u);
    EXPECT_EQ(summary.failures[0].rank, 1);
    EXPECT_EQ(summary.failures[0].code, "cannot-write");
    if (summary.failures[0].failure == "disk full") {
      EXPECT_LT(summary.tasks, test::small().tasks());
    }
  }
  other.join();
  run("a.db", 2);
  EXPECT_EQ(rows("a.db"), expected());
}

TEST_F(Ranks, ShardInUseIsRefused) {
  const auto busy = Store::create_or_open(rank_path(path("a.db"), 1), test::small());
  auto store = Store::create_or_open(path("a.db"), test::small());
  EXPECT_REFUSED(adopt_ranks(store), "database-busy", ".rank-1");
}

TEST_F(Ranks, InterruptedKeepWhatIsFinished) {
  interrupt_ = true;
  const auto summary = run("a.db", 3);
  EXPECT_TRUE(summary.interrupted);
  EXPECT_EQ(std::size_t(summary.tasks), rows("a.db")[0].size());
}

}  // namespace
}  // namespace clackers::campaign
