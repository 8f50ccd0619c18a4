#include "clackers/study/run_sinks.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clackers::study {
namespace {

// Goes on or not, and writes down what it was given.
class Scripted : public model::Sink {
 public:
  Scripted(std::string& log, std::string name, bool goes_on)
      : log_(log), name_(std::move(name)), goes_on_(goes_on) {}
  bool take(const model::SampleBlock& block) override {
    log_ += name_ + "b" + std::to_string(block.t.size());
    return goes_on_;
  }
  bool take(const model::ReportedImpact&) override {
    log_ += name_ + "i";
    return goes_on_;
  }

 private:
  std::string& log_;
  std::string name_;
  bool goes_on_;
};

const std::vector<double> t{0.0, 1.0}, u{1.0, 2.0, 3.0, 4.0}, v{5.0, 6.0, 7.0, 8.0};
const model::SampleBlock block{2, t, u, v};

TEST(RunRecorder, KeepsTheDisplacementsOfTheLastState) {
  std::string log;
  Scripted errors(log, "e", true);
  RunRecorder recorder(errors, nullptr);
  EXPECT_TRUE(recorder.last_u().empty());
  EXPECT_TRUE(recorder.take(block));
  EXPECT_EQ(recorder.last_u(), (std::vector<double>{3.0, 4.0}));
  EXPECT_TRUE(recorder.take(model::SampleBlock{2, {}, {}, {}}));
  EXPECT_EQ(recorder.last_u(), (std::vector<double>{3.0, 4.0}));
}

TEST(RunRecorder, GivesEverythingToStoreAndErrors) {
  std::string log;
  Scripted errors(log, "e", true), store(log, "s", true);
  RunRecorder recorder(errors, &store);
  EXPECT_TRUE(recorder.take(block));
  EXPECT_TRUE(recorder.take(model::ReportedImpact{}));
  EXPECT_EQ(log, "sb2eb2siei");
}

TEST(RunRecorder, EndsTheRunWhereEitherDoes) {
  for (const bool errors_stop : {true, false}) {
    std::string log;
    Scripted errors(log, "e", !errors_stop), store(log, "s", errors_stop);
    RunRecorder recorder(errors, &store);
    EXPECT_FALSE(recorder.take(block));
    EXPECT_FALSE(recorder.take(model::ReportedImpact{}));
  }
}

class CountingSink : public model::Sink {
 public:
  bool take(const model::SampleBlock& states_taken) override {
    states += states_taken.t.size();
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
  const model::SampleBlock one{1, values, values, values};
  EXPECT_TRUE(sink.take(one));
  EXPECT_TRUE(sink.take(model::ReportedImpact{}));
  EXPECT_EQ(inner.states, 3u);
  EXPECT_EQ(inner.impacts, 1u);
  inner.goes_on = false;
  EXPECT_FALSE(sink.take(one));
  EXPECT_FALSE(sink.take(model::ReportedImpact{}));
}

TEST(WatchedSink, EndsTheRunOnAnInterruptWithOrWithoutAnotherSink) {
  ProgressMeter meter(1.0, {});
  TaskShare share(meter, 1.0);
  CountingSink inner;
  std::atomic<bool> interrupt = false;
  WatchedSink sink(&inner, share, 1.0, &interrupt), alone(nullptr, share, 1.0, &interrupt);
  EXPECT_TRUE(sink.take(block));
  EXPECT_TRUE(alone.take(block));
  EXPECT_TRUE(alone.take(model::ReportedImpact{}));
  interrupt = true;
  EXPECT_FALSE(sink.take(block));
  EXPECT_FALSE(alone.take(block));
}

TEST(WatchedSink, CountsStatesAsProgressInLargePortions) {
  double last = 0.0;
  constexpr auto portion = WatchedSink::portion;
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
