#include "clackers/judge/cost/performance_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clackers::judge {
namespace {

// Three levels of one run: errors 0.05, 0.005, 0.0005 times `factor`, steps 100, 200, 400.
measure::Ladder ladder(double factor) {
  measure::Ladder result;
  for (int level = 0; level < 3; ++level) {
    measure::RunScore run;
    run.step = 0.1 * std::exp2(-level);
    run.finished = true;
    run.u_error = factor * 0.05 * std::pow(10.0, -level);
    run.work.steps = 100LL << level;
    result.push_back({run.step, {run}});
  }
  return result;
}

TEST(ProfileTasks, AreTheDecadesThatSomeMethodReaches) {
  CostTable table{{"good", "poor", "refused"}, {}, {{}, {}, {}}};
  const std::vector<measure::Ladder> ladders{ladder(1.0), ladder(10.0), {}};
  add_tasks(table, "stop", ladders, Counter::steps);
  EXPECT_EQ(table.tasks,
            (std::vector<std::string>{"stop: error in u <= 1e-01", "stop: error in u <= 1e-02",
                                      "stop: error in u <= 1e-03"}));
  EXPECT_EQ(table.costs[0], (std::vector<double>{100, 200, 400}));
  EXPECT_EQ(table.costs[1][1], 400);
  EXPECT_TRUE(std::isinf(table.costs[1][2]));
  EXPECT_TRUE(std::isinf(table.costs[2][0]));
  EXPECT_TRUE(has_ratios(table));
}

TEST(ProfileTasks, HaveNoRatiosToWorkThatCostsNothing) {
  CostTable table{{"good"}, {}, {{}}};
  EXPECT_FALSE(has_ratios(table));
  const std::vector<measure::Ladder> ladders{ladder(1.0)};
  add_tasks(table, "stop", ladders, Counter::event_searches);
  EXPECT_FALSE(has_ratios(table));
}

}  // namespace
}  // namespace clackers::judge
