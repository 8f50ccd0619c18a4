#include "clackers/campaign/ranks/server.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "clackers/campaign/ranks/client.hpp"
#include "clackers/campaign/ranks/testing/local_ranks.hpp"

namespace clackers::campaign {
namespace {

constexpr int size = 5;
constexpr long long tasks = 1000;

// Runs `work` in a thread for each rank but 0.
std::vector<std::thread> other_ranks(test::LocalRanks& ranks, auto work) {
  std::vector<std::thread> threads;
  for (int rank = 1; rank < size; ++rank)
    threads.emplace_back([&ranks, work, rank] { work(ranks[rank]); });
  return threads;
}

void join(std::vector<std::thread>& threads) {
  for (auto& thread : threads) thread.join();
}

TEST(Serve, EachTaskIsComputedOnce) {
  test::LocalRanks ranks(size);
  std::vector<std::atomic<int>> counts(tasks);
  auto threads = other_ranks(ranks, [&counts](Transport& transport) {
    Client client(transport);
    ASSERT_EQ(client.greet(), "what to do");
    RunSummary summary;
    while (const auto block = client.next())
      for (auto task = block->first; task < block->last; ++task) {
        ++counts[static_cast<std::size_t>(task)];
        ++summary.tasks;
      }
    EXPECT_FALSE(client.next());
    client.leave(summary);
  });
  Dispatcher dispatcher({{0, tasks}}, {.ranks = size});
  const auto results = serve(ranks[0], dispatcher, "what to do", false);
  join(threads);
  for (const auto& count : counts) EXPECT_EQ(count, 1);
  ASSERT_EQ(results.size(), size - 1u);
  long long sum = 0;
  for (const auto& result : results) sum += result.summary.tasks;
  EXPECT_EQ(sum, tasks);
}

TEST(Serve, AFailedRankLeavesTheOthersAtWork) {
  test::LocalRanks ranks(size);
  auto threads = other_ranks(ranks, [](Transport& transport) {
    Client client(transport);
    client.greet();
    RunSummary summary;
    if (transport.rank() == 2) {
      client.next();
      client.leave(summary, "disk full", "cannot-write");
      return;
    }
    while (client.next()) ++summary.runs;
    client.leave(summary);
  });
  Dispatcher dispatcher({{0, tasks}}, {.ranks = size});
  const auto results = serve(ranks[0], dispatcher, "what to do", false);
  join(threads);
  EXPECT_EQ(dispatcher.left(), 0);
  int failed = 0;
  for (const auto& result : results)
    if (!result.failure.empty()) {
      ++failed;
      EXPECT_EQ(result.rank, 2);
      EXPECT_EQ(result.failure, "disk full");
      EXPECT_EQ(result.code, "cannot-write");
    }
  EXPECT_EQ(failed, 1);
}

TEST(Serve, InterruptedGivesNoMoreBlocks) {
  test::LocalRanks ranks(size);
  std::atomic<bool> interrupt = false;
  auto threads = other_ranks(ranks, [&interrupt](Transport& transport) {
    Client client(transport);
    client.greet();
    client.next();
    interrupt = true;
    while (client.next()) std::this_thread::yield();
    client.leave({0, 0, true});
  });
  Dispatcher dispatcher({{0, 1000000000000}}, {.ranks = size});
  const auto results = serve(ranks[0], dispatcher, "what to do", interrupt);
  join(threads);
  for (const auto& result : results) EXPECT_TRUE(result.summary.interrupted);
}

TEST(StopAllRanks, EveryRankGetsStop) {
  test::LocalRanks ranks(size);
  auto threads = other_ranks(ranks, [](Transport& transport) {
    Client client(transport);
    EXPECT_FALSE(client.greet());
    EXPECT_FALSE(client.next());
    client.leave({});
  });
  stop_all_ranks(ranks[0]);
  join(threads);
}

}  // namespace
}  // namespace clackers::campaign
