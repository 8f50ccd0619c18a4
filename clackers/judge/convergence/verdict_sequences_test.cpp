#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/judge/convergence/ladder_fit.hpp"
#include "clackers/judge/testing/expect_behaviour.hpp"
#include "clackers/judge/testing/verdict_sequence.hpp"

namespace clackers::judge {
namespace {

using namespace synthetic;

TEST_P(VerdictSequences, IsJudgedAsAnExpertWould) {
  const auto& row = GetParam();
  auto ladder = scores_of(row.make());
  if (row.change) row.change(ladder);
  const auto found = judge(ladder, row.claim,
                           {.contact_time = row.contact_time, .by_tolerance = row.by_tolerance});
  const auto& fit = found.displacement;
  EXPECT_EQ(to_string(fit.behaviour), to_string(row.behaviour)) << text(fit);
  EXPECT_EQ(fit.reason, row.reason) << text(fit);
  EXPECT_EQ(to_string(found.verdict), to_string(row.verdict)) << text(fit);
  EXPECT_EQ(fit.has_line, row.within > 0.0) << text(fit);
  if (row.within > 0.0) {
    EXPECT_NEAR(fit.order, row.order, row.within) << text(fit);
  }
}

TEST(LadderOrder, ALadderGivenFinestFirstIsRefused) {
  auto made = ladder([](double h) { return h * h; });
  std::ranges::reverse(made);
  EXPECT_THROW(fit_ladder(made, {.claimed_order = 2.0}), InputError);
}

TEST(LadderOrder, AStepInTwoLevelsIsRefusedAndTwiceInOneIsNot) {
  auto made = ladder([](double h) { return h * h; }, single);
  auto twice = made;
  twice.insert(twice.begin() + 3, twice[3]);
  EXPECT_THROW(fit_ladder(twice, {.claimed_order = 2.0}), InputError);
  for (auto& level : made) level.insert(level.end(), 2, level.front());
  const auto fit = fit_ladder(made, {.claimed_order = 2.0});
  EXPECT_BEHAVIOUR(fit, Behaviour::proper, "");
  EXPECT_NEAR(fit.order, 2.0, 1e-9);
}

}  // namespace
}  // namespace clackers::judge
