#include "clackers/solvers/plugin/plugin_output.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "clackers/input/events.hpp"
#include "clackers/input/history.hpp"

namespace clackers::solvers {
namespace {

namespace fs = std::filesystem;
using Numbers = std::vector<double>;

class PluginOutputTest : public testing::Test {
 protected:
  PluginOutputTest() { output_.accept(true); }
  ~PluginOutputTest() override {
    fs::remove(history_);
    fs::remove(events_);
  }

  model::Trajectory history() const {
    return input::read_history(history_.string(), {.dof = 2}).motion;
  }
  int state(double t, const double* v = nullptr, const double* a = nullptr) {
    return output_.state(&output_, t, u_, v, a);
  }

  // Tests run beside each other.
  static fs::path file(const std::string& name) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    return fs::path(testing::TempDir()) / fmt::format("{}_{}.npy", test->name(), name);
  }

  const fs::path history_ = file("history"), events_ = file("events");
  PluginOutput output_{2, history_, events_};
  const double u_[2] = {1.0 / 3.0, -1e-300};
  const double v_[2] = {0.0, 2.0}, after_[2] = {0.5, -2.0};
};

TEST_F(PluginOutputTest, StatesReadBackToTheSameNumbers) {
  EXPECT_EQ(state(0.0, v_, after_), 0);
  EXPECT_EQ(state(0.1, v_, after_), 0);
  output_.commit();
  const auto motion = history();
  EXPECT_EQ(motion.t, (Numbers{0.0, 0.1}));
  EXPECT_EQ(motion.u, (Numbers{u_[0], u_[1], u_[0], u_[1]}));
  EXPECT_EQ(motion.v, (Numbers{0.0, 2.0, 0.0, 2.0}));
  EXPECT_EQ(motion.a, (Numbers{0.5, -2.0, 0.5, -2.0}));
  EXPECT_FALSE(fs::exists(events_));
}

TEST_F(PluginOutputTest, CollisionsHaveTheirOwnFile) {
  EXPECT_EQ(state(0.0), 0);
  EXPECT_EQ(state(1.0), 0);
  EXPECT_EQ(output_.collision(&output_, 0.25, 3.0, v_, after_), 0);
  output_.commit();
  EXPECT_TRUE(history().v.empty());
  const auto impacts = input::read_events(events_.string(), 2);
  ASSERT_EQ(impacts.size(), 1u);
  EXPECT_EQ(impacts[0].t, 0.25);
  EXPECT_EQ(impacts[0].impulse, 3.0);
  EXPECT_EQ(impacts[0].v_before, (Numbers{0.0, 2.0}));
  EXPECT_EQ(impacts[0].v_after, (Numbers{0.5, -2.0}));
}

TEST_F(PluginOutputTest, FilesAppearAtTheEnd) {
  for (int i = 0; i < 10000; ++i) EXPECT_EQ(state(0.1 * i, v_), 0);
  EXPECT_FALSE(fs::exists(history_));
  output_.commit();
  const auto motion = history();
  ASSERT_EQ(motion.t.size(), 10000u);
  for (std::size_t i = 0; i < motion.t.size(); ++i) EXPECT_EQ(motion.t[i], 0.1 * int(i));
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
  EXPECT_EQ(states, 41);  // of 24 bytes
  PluginOutput events(2, history_, events_, 1000);
  events.accept(true);
  while (events.collision(&events, collisions, 0.0, nullptr, nullptr) == 0) ++collisions;
  EXPECT_EQ(events.failure(), "host->collision: more than 1000 bytes");
  EXPECT_EQ(collisions, 62);  // of 16 bytes
}

TEST_F(PluginOutputTest, IsOfTheVersionOfTheHeader) {
  EXPECT_EQ(output_.version, CLACKERS_SOLVER_VERSION);
}

}  // namespace
}  // namespace clackers::solvers
