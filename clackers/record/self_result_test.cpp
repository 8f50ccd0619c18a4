#include "clackers/record/self_result.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::record {
namespace {

using Values = std::vector<double>;

// Runs of two neighbouring steps a level, six halvings from 0.1 s, the value of one mass each.
std::vector<judge::ResponseLevel> runs_of(const auto& value) {
  std::vector<judge::ResponseLevel> levels;
  for (int j = 0; j < 6; ++j) {
    levels.emplace_back();
    for (const double h : {0.1 * std::exp2(-j), 0.1 * std::exp2(-j - 0.5)})
      levels.back().push_back({h, {value(h)}, 1e-15});
  }
  return levels;
}

constexpr double exact = 0.25;
const judge::SelfContext second_order{.claimed_order = 2.0};

TEST(SelfResult, TellsTheReferenceOfRunsThatConvergeToTheTrueMotion) {
  const auto result = self_result(runs_of([](double h) { return exact + 3.0 * h * h; }),
                                  Values{exact}, second_order);
  EXPECT_EQ(result.order, 2.0);
  EXPECT_TRUE(result.self.proper);
  EXPECT_FALSE(result.against_reference.false_convergence);
  EXPECT_EQ(result.errors.behaviour, Behaviour::proper);
  // The pseudo error of C h^2 is the error of the finer run.
  EXPECT_NEAR(result.against_reference.error_ratio, 1.0, 1e-6);
  ASSERT_TRUE(result.extrapolation.bounded);
  EXPECT_EQ(result.extrapolation.level, 5);
  // Six digits of h^2 at h = 0.1 / 32, of which the extrapolation leaves rounding alone.
  EXPECT_LT(result.extrapolation_error, 1e-13);
}

TEST(SelfResult, NamesALimitThatIsNotTheTrueMotion) {
  const auto result = self_result(runs_of([](double h) { return exact + 0.05 + 3.0 * h * h; }),
                                  Values{exact}, second_order);
  EXPECT_TRUE(result.against_reference.false_convergence);
  ASSERT_TRUE(result.extrapolation.bounded);
  EXPECT_NEAR(result.extrapolation_error, 0.05, 1e-12);
  EXPECT_GT(result.extrapolation_error, 1e3 * result.extrapolation.bound);
}

TEST(SelfResult, TakesTheLargestDistanceOfAllMasses) {
  auto runs = runs_of([](double h) { return exact + 3.0 * h * h; });
  for (auto& level : runs)
    for (auto& run : level) run.values.insert(run.values.end(), {0.07, 0.03});
  const auto result = self_result(runs, Values{exact, 0.06, 0.03}, second_order);
  EXPECT_NEAR(result.extrapolation_error, 0.01, 1e-12);
}

TEST(SelfResult, HasNoExtrapolationOfRunsThatAreNotProper) {
  const auto result =
      self_result(runs_of([](double h) { return exact + 3.0 * h; }), Values{exact}, second_order);
  EXPECT_FALSE(result.self.proper);
  EXPECT_FALSE(result.extrapolation.bounded);
  EXPECT_FALSE(result.extrapolation.reason.empty());
  EXPECT_TRUE(std::isnan(result.extrapolation_error));
}

TEST(SelfResult, ExtrapolatesFromTheFirstRunOfEachLevel) {
  auto runs = runs_of([](double h) { return exact + 3.0 * h * h; });
  for (auto& level : runs) level.back().values = {std::nan("")};
  const auto result = self_result(runs, Values{exact}, second_order);
  EXPECT_LT(result.extrapolation_error, 1e-13);
}

TEST(SelfResult, LeavesOutLevelsOfFewerRunsThanTheFinest) {
  auto runs = runs_of([](double h) { return exact + 3.0 * h * h; });
  runs.front().pop_back();
  const auto result = self_result(runs, Values{exact}, second_order);
  EXPECT_EQ(result.errors.errors.size(), 5u);
  EXPECT_TRUE(result.self.proper);
}

TEST(SelfResult, AsksForAnOrder) {
  EXPECT_THROW(self_result(runs_of([](double h) { return h; }), Values{exact}, {}), InputError);
}

}  // namespace
}  // namespace clackers::record
