#include "clackers/judge/cost/performance_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::judge {
namespace {

constexpr double none = HUGE_VAL;

// By hand: best costs 1, 2, 4, 3, and none for the last.
CostTable five_tasks() {
  return {.methods = {"a", "b", "c"},
          .tasks = {"p1", "p2", "p3", "p4", "p5"},
          .costs = {
              {1.0, 4.0, 4.0, NAN, none}, {2.0, 2.0, none, 3.0, NAN}, {4.0, 2.0, 8.0, 6.0, none}}};
}

TEST(PerformanceProfile, RatiosAreCostsOverTheBestOfEachTask) {
  const auto found = performance_profile(five_tasks());
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].method, "a");
  EXPECT_EQ(found[0].ratios, (std::vector{1.0, 2.0, 1.0, none, none}));
  EXPECT_EQ(found[1].ratios, (std::vector{2.0, 1.0, none, 1.0, none}));
  EXPECT_EQ(found[2].ratios, (std::vector{4.0, 1.0, 2.0, 2.0, none}));
}

TEST(PerformanceProfile, ALineRisesAtItsRatiosToTheShareThatIsSolved) {
  const auto found = performance_profile(five_tasks());
  const auto& c = found[2].steps;
  ASSERT_EQ(c.size(), 3u);
  const double ratio[] = {1, 2, 4}, share[] = {0.2, 0.6, 0.8};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(c[i].ratio, ratio[i]);
    EXPECT_DOUBLE_EQ(c[i].share, share[i]);
  }
  EXPECT_DOUBLE_EQ(found[0].steps.back().share, 0.6);
}

TEST(PerformanceProfile, FailuresAreCounted) {
  const auto found = performance_profile(five_tasks());
  EXPECT_EQ(found[0].failed, 2);
  EXPECT_EQ(found[1].failed, 2);
  EXPECT_EQ(found[2].failed, 1);
}

TEST(PerformanceProfile, ATieIsBestForBoth) {
  const auto found = performance_profile(five_tasks());
  EXPECT_EQ(found[0].best, 2);
  EXPECT_EQ(found[1].best, 2);
  EXPECT_EQ(found[2].best, 1);
}

TEST(PerformanceProfile, SharesAreReadOffTheLine) {
  const auto found = performance_profile(five_tasks());
  const auto& c = found[2];
  EXPECT_DOUBLE_EQ(share_within(c, 1.0), 0.2);
  EXPECT_DOUBLE_EQ(share_within(c, 1.99), 0.2);
  EXPECT_DOUBLE_EQ(share_within(c, 2.0), 0.6);
  EXPECT_DOUBLE_EQ(share_within(c, 3.99), 0.6);
  EXPECT_DOUBLE_EQ(share_within(c, none), 0.8);
  EXPECT_THROW(share_within(c, 0.99), InputError);
  EXPECT_THROW(share_within(c, NAN), InputError);
}

TEST(PerformanceProfile, AMethodThatSolvesNothingHasALineAtZero) {
  const auto found =
      performance_profile({.methods = {"a", "b"}, .tasks = {"p"}, .costs = {{NAN}, {3.0}}});
  EXPECT_TRUE(found[0].steps.empty());
  EXPECT_EQ(share_within(found[0], none), 0.0);
  EXPECT_EQ(found[0].best, 0);
  EXPECT_DOUBLE_EQ(share_within(found[1], 1.0), 1.0);
}

TEST(PerformanceProfile, RefusesTablesThatDoNotFitAndCostsWithoutARatio) {
  auto table = five_tasks();
  table.costs[1][1] = 0.0;
  EXPECT_THROW(performance_profile(table), InputError);
  table.costs[1][1] = -HUGE_VAL;
  EXPECT_THROW(performance_profile(table), InputError);
  table = five_tasks();
  table.costs[1].pop_back();
  EXPECT_THROW(performance_profile(table), InputError);
  table = five_tasks();
  table.costs.pop_back();
  EXPECT_THROW(performance_profile(table), InputError);
  EXPECT_THROW(performance_profile({.methods = {"a"}, .tasks = {}, .costs = {{}}}), InputError);
}

}  // namespace
}  // namespace clackers::judge
