#include "clackers/base/jobs/work_queue.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "clackers/base/error.hpp"

namespace clackers {
namespace {

TEST(WorkQueue, DoesEachPieceOnceWithAnyNumberOfThreads) {
  for (const int threads : {1, 2, 7, 100}) {
    std::vector<std::atomic<int>> done(50);
    run_all(done.size(), threads, [&](std::size_t i) { ++done[i]; });
    for (const auto& times : done) EXPECT_EQ(times, 1);
  }
  run_all(0, 4, [](std::size_t) { FAIL(); });
}

TEST(WorkQueue, StartsInOrder) {
  std::vector<std::size_t> order;
  run_all(20, 1, [&](std::size_t i) { order.push_back(i); });
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i);
}

TEST(WorkQueue, WorksOnAsManyThreadsAsAskedFor) {
  // Each piece waits for all three to be there; with fewer threads none would go on.
  std::atomic<int> here = 0;
  std::atomic<bool> late = false;
  run_all(3, 3, [&](std::size_t) {
    ++here;
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (here < 3 && !late) late = std::chrono::steady_clock::now() > limit;
  });
  EXPECT_FALSE(late);
}

TEST(WorkQueue, HandsOnTheFirstExceptionAndStartsNothingMore) {
  for (const int threads : {1, 3}) {
    std::atomic<int> started = 0;
    EXPECT_THROW(run_all(1000, threads,
                         [&](std::size_t i) {
                           ++started;
                           if (i == 5) throw std::runtime_error("five");
                           if (i > 5) std::this_thread::sleep_for(std::chrono::milliseconds(1));
                         }),
                 std::runtime_error);
    EXPECT_LT(started, 1000);
  }
}

TEST(WorkQueue, TakesJobsAsThreadsAndZeroAsOneAProcessor) {
  EXPECT_EQ(thread_count(3), 3);
  EXPECT_GE(thread_count(0), 1);
  for (const int jobs : {-1, 1025}) EXPECT_THROW(thread_count(jobs), InputError);
  try {
    thread_count(-1);
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "verify: jobs = -1; allowed: 0 <= jobs <= 1024. 0 takes one thread per processor.");
    EXPECT_EQ(error.code().name(), "out-of-range");
  }
}

}  // namespace
}  // namespace clackers
