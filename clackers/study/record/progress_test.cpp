#include "clackers/study/verify/progress_meter.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

#include "clackers/study/verify/watched_sink.hpp"

namespace clackers::study {
namespace {

TEST(ProgressMeter, TellsSharesThatNeverFallAndEndAtOne) {
  std::vector<double> told;
  ProgressMeter meter(8.0, [&](double share) { told.push_back(share); });
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < 8; ++k) {
    meter.add(1.0);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  meter.finish();
  ASSERT_GE(told.size(), 3u);
  EXPECT_EQ(told.front(), 0.125);
  EXPECT_EQ(told.back(), 1.0);
  for (std::size_t k = 1; k < told.size(); ++k) EXPECT_GE(told[k], told[k - 1]);
  // At most one message every 50 ms, and the first and the last.
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  EXPECT_LE(double(told.size()), passed.count() / 0.05 + 2.0);
}

TEST(ProgressMeter, TellsOneAtATimeFromManyThreads) {
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

TEST(ProgressMeter, NeedsNobodyToTell) {
  ProgressMeter meter(1.0, {});
  meter.add(1.0);
  meter.finish();
}

TEST(ProgressMeter, NeverTellsMoreThanAll) {
  std::vector<double> told;
  ProgressMeter meter(1.0, [&](double share) { told.push_back(share); });
  meter.add(1.5);
  EXPECT_EQ(told, std::vector<double>{1.0});
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

class CountingSink : public model::Sink {
 public:
  bool take(const model::SampleBlock& block) override {
    states += block.t.size();
    return goes_on;
  }
  bool take(const model::ReportedImpact&) override {
    ++impacts;
    return goes_on;
  }
  std::size_t states = 0, impacts = 0;
  bool goes_on = true;
};

TEST(WatchedSink, PassesTheRunOnAndItsAnswersBack) {
  ProgressMeter meter(1.0, {});
  TaskShare share(meter, 1.0);
  CountingSink inner;
  WatchedSink sink(&inner, share, 1.0, nullptr);
  const std::vector<double> values(3);
  const model::SampleBlock block{1, values, values, values};
  EXPECT_TRUE(sink.take(block));
  EXPECT_TRUE(sink.take(model::ReportedImpact{}));
  EXPECT_EQ(inner.states, 3u);
  EXPECT_EQ(inner.impacts, 1u);
  inner.goes_on = false;
  EXPECT_FALSE(sink.take(block));
  EXPECT_FALSE(sink.take(model::ReportedImpact{}));
}

TEST(WatchedSink, EndsTheRunOnAnInterruptWithOrWithoutAnotherSink) {
  ProgressMeter meter(1.0, {});
  TaskShare share(meter, 1.0);
  CountingSink inner;
  std::atomic<bool> interrupt = false;
  WatchedSink sink(&inner, share, 1.0, &interrupt), alone(nullptr, share, 1.0, &interrupt);
  const model::SampleBlock block{};
  EXPECT_TRUE(sink.take(block));
  EXPECT_TRUE(alone.take(block));
  EXPECT_TRUE(alone.take(model::ReportedImpact{}));
  interrupt = true;
  EXPECT_FALSE(sink.take(block));
  EXPECT_FALSE(alone.take(block));
}

TEST(WatchedSink, CountsStatesAsProgressInLargePortions) {
  double last = 0.0;
  constexpr auto portion = WatchedSink::told_at_once;
  ProgressMeter meter(4.0 * double(portion), [&](double share) { last = share; });
  TaskShare share(meter, 4.0 * double(portion));
  WatchedSink sink(nullptr, share, 2.0, nullptr);
  const std::vector<double> values(portion / 2);
  sink.take({1, values, values, values});
  EXPECT_EQ(last, 0.0);
  sink.take({1, values, values, values});
  EXPECT_EQ(last, 0.5);
}

}  // namespace
}  // namespace clackers::study
