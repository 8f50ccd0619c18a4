#include "clackers/assess/convergence/observed_order.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::assess {
namespace {

TEST(ObservedOrder, IsThatOfAPowerWhateverItsSign) {
  for (const double q : {0.5, 1.0, 2.0, 4.0}) {
    const auto found = observed_order([&](double h) { return -3.0 * std::pow(h, q); }, 1.0 / 16, 5);
    EXPECT_NEAR(found.order, q, 1e-12);
    EXPECT_LT(found.spread, 1e-10);
    EXPECT_EQ(found.behaviour, Behaviour::proper);
  }
}

TEST(ObservedOrder, PrefersTheFinestLevels) {
  const auto found =
      observed_order([](double h) { return h * h + 40.0 * h * h * h * h; }, 1.0 / 4, 8);
  EXPECT_NEAR(found.order, 2.0, 0.05) << "spread " << found.spread;
}

TEST(ObservedOrder, StopsAtRounding) {
  const auto found = observed_order(
      [](double h) { return std::pow(h, 4) + 3e-16 / h * (1.5 + std::sin(1e3 / h)); }, 1.0 / 16, 9);
  EXPECT_NEAR(found.order, 4.0, 0.05) << "spread " << found.spread;
}

TEST(ObservedOrder, ARunAtEveryStepWithTheSpreadOfItsScatter) {
  const auto found = observed_order(
      [](double h) { return h * h * (h < 1.0 / 100 && h > 1.0 / 200 ? 1.1 : 1.0); }, 1.0 / 16, 7);
  EXPECT_NEAR(found.order, 2.0, 0.05);
  EXPECT_GT(found.spread, 0.005);
  EXPECT_LT(found.spread, 0.2);
}

TEST(ObservedOrder, HasNoNumberWhereThereIsNoLine) {
  for (const auto& error : {+[](double) { return 1.0; }, +[](double) { return double(NAN); },
                            +[](double) { return 0.0; }}) {
    const auto found = observed_order(error, 0.1, 6);
    EXPECT_TRUE(std::isnan(found.order));
    EXPECT_TRUE(std::isnan(found.spread));
    EXPECT_NE(found.behaviour, Behaviour::proper);
  }
}

TEST(ObservedOrder, RefusesTooFewLevelsAndStepsThatAreNotPositive) {
  const auto one = [](double) { return 1.0; };
  EXPECT_THROW(observed_order(one, 0.1, 3), InputError);
  EXPECT_THROW(observed_order(one, 0.0, 5), InputError);
  EXPECT_THROW(observed_order(one, NAN, 5), InputError);
}

}  // namespace
}  // namespace clackers::assess
