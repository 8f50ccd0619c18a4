#include "clackers/numerics/roots.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <vector>

namespace clackers::numerics {
namespace {

struct Task {
  std::function<double(double)> f;
  double a, b, root;
};

const std::vector<Task> tasks = {
    {[](double x) { return 1.0 - x; }, 0.0, 3.0, 1.0},
    {[](double x) { return std::cos(x); }, 0.3, 3.0, std::acos(-1.0) / 2},
    {[](double x) { return -std::pow(x - 0.7, 3); }, 0.0, 1.0, 0.7},
    {[](double x) { return x < 0.123 ? 1e-9 : -1e9; }, -1.0, 1.0, 0.123},
    {[](double x) { return std::exp(-40 * x) - 0.5; }, 0.0, 1.0, std::log(2.0) / 40},
};

TEST(Shrink, EnclosesTheRootInTheWidthAskedForAtMostTwoEvaluationsAfterBisection) {
  for (const auto& task : tasks)
    for (const double width : {0.1, 1e-6, 1e-13}) {
      int evaluations = 0;
      const auto k = shrink([&](double x) { return ++evaluations, task.f(x); },
                            {task.a, task.f(task.a), task.b, task.f(task.b)}, width);
      EXPECT_LE(k.width(), width);
      EXPECT_GE(k.fa, 0.0);
      EXPECT_LT(k.fb, 0.0);
      EXPECT_EQ(k.fa, task.f(k.a));
      EXPECT_EQ(k.fb, task.f(k.b));
      // The library's root may sit one rounding outside the sign change of its own function.
      EXPECT_NEAR(task.root, k.a, width + 1e-15);
      EXPECT_LE(evaluations, 2 + std::ceil(std::log2((task.b - task.a) / width)));
    }
}

TEST(Shrink, NeedsFewEvaluationsForASmoothFunction) {
  int evaluations = 0;
  shrink([&](double x) { return ++evaluations, std::cos(x); },
         {1.5, std::cos(1.5), 1.6, std::cos(1.6)}, 1e-16);
  EXPECT_LE(evaluations, 10);  // bisection takes 50
}

TEST(Shrink, EndsWhereNoDoubleIsLeftBetween) {
  const auto k =
      shrink([](double x) { return 1e6 / 3 - x; }, {0.0, 1e6 / 3, 1e6, -2e6 / 3}, 1e-300);
  EXPECT_EQ(std::nextafter(k.a, 2e6), k.b);
}

TEST(Shrink, EndsForAFunctionThatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_LE(shrink([&](double) { return nan; }, {0.0, 1.0, 1.0, -1.0}, 1e-9).width(), 1e-9);
}

}  // namespace
}  // namespace clackers::numerics
