#include "clackers/study/verify/run_recorder.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clackers::study {
namespace {

// Takes what it is told to take, and writes down what it was given.
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
  Scripted judge(log, "j", true);
  RunRecorder recorder(judge, nullptr);
  EXPECT_TRUE(recorder.last_u().empty());
  EXPECT_TRUE(recorder.take(block));
  EXPECT_EQ(recorder.last_u(), (std::vector<double>{3.0, 4.0}));
  EXPECT_TRUE(recorder.take(model::SampleBlock{2, {}, {}, {}}));
  EXPECT_EQ(recorder.last_u(), (std::vector<double>{3.0, 4.0}));
}

TEST(RunRecorder, GivesEverythingToStoreAndJudge) {
  std::string log;
  Scripted judge(log, "j", true), store(log, "s", true);
  RunRecorder recorder(judge, &store);
  EXPECT_TRUE(recorder.take(block));
  EXPECT_TRUE(recorder.take(model::ReportedImpact{}));
  EXPECT_EQ(log, "sb2jb2siji");
}

TEST(RunRecorder, EndsTheRunWhereEitherDoes) {
  for (const bool judge_stops : {true, false}) {
    std::string log;
    Scripted judge(log, "j", !judge_stops), store(log, "s", judge_stops);
    RunRecorder recorder(judge, &store);
    EXPECT_FALSE(recorder.take(block));
    EXPECT_FALSE(recorder.take(model::ReportedImpact{}));
  }
}

}  // namespace
}  // namespace clackers::study
