#include "clackers/study/options.hpp"

#include <gtest/gtest.h>

namespace clackers::study {
namespace {

TEST(VerifyOptions, AreSetByName) {
  VerifyRequest request;
  set_options(
      request,
      {{"levels", 3}, {"coarsest", 0.25}, {"samples-per-level", 5}, {"budget", 7.5}, {"jobs", 2}});
  EXPECT_EQ(request.plan.levels, 3);
  EXPECT_EQ(request.plan.coarsest, 0.25);
  EXPECT_EQ(request.plan.samples_per_level, 5);
  EXPECT_EQ(request.budget, 7.5);
  EXPECT_EQ(request.jobs, 2);
}

TEST(VerifyOptions, HaveABudgetUnlessLevelsAreGiven) {
  VerifyRequest request;
  set_options(request, {});
  EXPECT_EQ(request.budget, default_budget);
  EXPECT_FALSE(request.plan.levels || request.plan.coarsest || request.plan.samples_per_level);
  set_options(request, {{"levels", 3}});
  EXPECT_EQ(request.budget, 0.0);
}

}  // namespace
}  // namespace clackers::study
