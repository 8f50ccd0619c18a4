#include "clackers/study/plugin/plugin_output.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>

namespace clackers::study {
namespace {

namespace fs = std::filesystem;

class PluginOutputTest : public testing::Test {
 protected:
  PluginOutputTest() { output_.accept(true); }
  ~PluginOutputTest() override {
    fs::remove(history_);
    fs::remove(events_);
  }

  static std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  int state(double t, const double* v = nullptr, const double* a = nullptr) {
    return output_.state(&output_, t, u_, v, a);
  }

  const fs::path history_ = fs::path(testing::TempDir()) / "plugin_history.csv";
  const fs::path events_ = fs::path(testing::TempDir()) / "plugin_events.csv";
  PluginOutput output_{2, history_, events_};
  const double u_[2] = {1.0 / 3.0, -1e-300};
  const double v_[2] = {0.0, 2.0}, after_[2] = {0.5, -2.0};
};

TEST_F(PluginOutputTest, StatesReadBackToTheSameNumbers) {
  EXPECT_EQ(state(0.0, v_, after_), 0);
  EXPECT_EQ(state(0.1, v_, after_), 0);
  output_.commit();
  EXPECT_EQ(text_of(history_),
            "t,u1,u2,v1,v2,a1,a2\n0,0.3333333333333333,-1e-300,0,2,0.5,-2\n"
            "0.1,0.3333333333333333,-1e-300,0,2,0.5,-2\n");
  EXPECT_FALSE(fs::exists(events_));
}

TEST_F(PluginOutputTest, CollisionsHaveTheirOwnFile) {
  EXPECT_EQ(state(0.0), 0);
  EXPECT_EQ(state(1.0), 0);
  EXPECT_EQ(output_.collision(&output_, 0.25, 3.0, v_, after_), 0);
  output_.commit();
  EXPECT_EQ(text_of(events_), "t,impulse,v1-,v2-,v1+,v2+\n0.25,3,0,2,0.5,-2\n");
  EXPECT_EQ(text_of(history_).substr(0, 8), "t,u1,u2\n");
}

TEST_F(PluginOutputTest, FilesAppearAtTheEnd) {
  for (int i = 0; i < 10000; ++i) EXPECT_EQ(state(0.1 * i, v_), 0);
  EXPECT_FALSE(fs::exists(history_));
  output_.commit();
  const auto text = text_of(history_);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10001);
}

TEST_F(PluginOutputTest, NothingIsLeftWithoutCommit) {
  {
    PluginOutput other(2, history_, events_);
    other.accept(true);
    for (int i = 0; i < 10000; ++i) other.state(&other, 0.1 * i, u_, v_, nullptr);
  }
  EXPECT_FALSE(fs::exists(history_));
  EXPECT_FALSE(fs::exists(history_.string() + ".part"));
}

TEST_F(PluginOutputTest, NothingIsTakenAfterAFailure) {
  EXPECT_EQ(state(0.0), 0);
  EXPECT_NE(state(std::numeric_limits<double>::infinity()), 0);
  EXPECT_EQ(output_.failure_code(), "not-finite");
  EXPECT_NE(state(1.0), 0);
  EXPECT_NE(output_.fail(&output_, "later"), 0);
  EXPECT_EQ(output_.failure_code(), "not-finite");
}

TEST_F(PluginOutputTest, TwoStatesOfOneTimeAreAJump) {
  for (const double t : {0.0, 1.0, 1.0, 2.0, 2.0}) EXPECT_EQ(state(t), 0);
  EXPECT_NE(state(2.0), 0);
  EXPECT_EQ(output_.failure_code(), "three-limits");
}

TEST_F(PluginOutputTest, HasALargestSize) {
  PluginOutput other(2, history_, events_, 1000);
  other.accept(true);
  int states = 0, collisions = 0;
  while (other.state(&other, states, u_, nullptr, nullptr) == 0) ++states;
  EXPECT_EQ(other.failure_code(), "program-output");
  EXPECT_EQ(other.failure(), "host->state: more than 1000 bytes");
  EXPECT_EQ(states, 33);  // 8 bytes of names; 29 bytes each up to t = 9, then 30
  PluginOutput events(2, history_, events_, 1000);
  events.accept(true);
  while (events.collision(&events, collisions, 0.0, nullptr, nullptr) == 0) ++collisions;
  EXPECT_EQ(events.failure(), "host->collision: more than 1000 bytes");
  EXPECT_GT(collisions, 100);
}

TEST_F(PluginOutputTest, IsOfTheVersionOfTheHeader) {
  EXPECT_EQ(output_.version, CLACKERS_SOLVER_VERSION);
}

}  // namespace
}  // namespace clackers::study
