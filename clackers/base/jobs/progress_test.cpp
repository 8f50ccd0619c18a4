#include "clackers/base/jobs/progress.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace clackers {
namespace {

TEST(ProgressMeter, ReportsSharesThatNeverFallAndEndAtOne) {
  std::vector<double> shares;
  ProgressMeter meter(8.0, [&](double share) { shares.push_back(share); });
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < 8; ++k) {
    meter.add(1.0);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  meter.finish();
  ASSERT_GE(shares.size(), 3u);
  EXPECT_EQ(shares.front(), 0.125);
  EXPECT_EQ(shares.back(), 1.0);
  for (std::size_t k = 1; k < shares.size(); ++k) EXPECT_GE(shares[k], shares[k - 1]);
  // At most one message every 50 ms, and the first and the last.
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  EXPECT_LE(double(shares.size()), passed.count() / 0.05 + 2.0);
}

TEST(ProgressMeter, ReportsOneAtATimeFromManyThreads) {
  int inside = 0, most = 0;
  ProgressMeter meter(1e5, [&](double) {
    most = std::max(most, ++inside);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --inside;
  });
  {
    std::vector<std::jthread> threads;
    for (int k = 0; k < 4; ++k)
      threads.emplace_back([&] {
        for (int i = 0; i < 25000; ++i) meter.add(1.0);
      });
  }
  meter.finish();
  EXPECT_EQ(most, 1);
}

TEST(ProgressMeter, WorksWithoutACallback) {
  ProgressMeter meter(1.0, {});
  meter.add(1.0);
  meter.finish();
}

TEST(ProgressMeter, NeverReportsMoreThanAll) {
  std::vector<double> shares;
  ProgressMeter meter(1.0, [&](double share) { shares.push_back(share); });
  meter.add(1.5);
  EXPECT_EQ(shares, std::vector<double>{1.0});
}

TEST(TaskShare, AddsItsWholeCostHoweverTheTaskWent) {
  for (const double used : {0.0, 0.25, 5.0}) {
    double last = 0.0;
    ProgressMeter meter(4.0, [&](double share) { last = share; });
    {
      TaskShare share(meter, 2.0);
      std::this_thread::sleep_for(std::chrono::milliseconds(60));
      share.add(used);
      EXPECT_EQ(last, std::min(used, 2.0) / 4.0);
      std::this_thread::sleep_for(std::chrono::milliseconds(60));
    }
    EXPECT_EQ(last, 0.5);
  }
}

}  // namespace
}  // namespace clackers
