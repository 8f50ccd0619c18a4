#include "clackers/study/check/initial_state.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clackers::study {
namespace {

FirstRow start_of(const cases::Case& problem) {
  const auto now = problem.motion->at(0.0, model::Side::right);
  return {0.0, {now.u[0], now.u[1]}, {now.v[0], now.v[1]}};
}

TEST(InitialState, DifferenceIsRelativeToTheEnvelopes) {
  const auto problem = cases::make("three-parameter");
  auto row = start_of(problem);
  EXPECT_EQ(start_difference(row, problem).relative, 0.0);
  row.u[1] += 0.01;  // of an envelope of 1/3
  EXPECT_NEAR(start_difference(row, problem).relative, 0.03, 1e-4);
  row.u[1] = std::nan("");
  EXPECT_EQ(start_difference(row, problem).relative, 0.0);
}

TEST(InitialState, DifferenceNamesTheNumberThatIsFarthest) {
  const auto row = start_of(cases::make("three-parameter", {{"N", 3.0}}));
  const auto most = start_difference(row, cases::make("three-parameter"));
  EXPECT_EQ(most.name, "u2");
  EXPECT_NEAR(most.given, -3.0 / 13.0, 1e-15);
  EXPECT_NEAR(most.expected, -1.0 / 3.0, 1e-15);
  const FirstRow nothing{0.0, {std::nan(""), std::nan("")}, {}};
  EXPECT_TRUE(start_difference(nothing, cases::make("three-parameter")).name.empty());
}

}  // namespace
}  // namespace clackers::study
