#include "clackers/exact/flights/first_crossing.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clackers::exact {
namespace {

// a s - j s^3/6 with the bounds of a fine mesh, whose modes could do more.
struct Hump {
  double a = 1e-6, j = 1e6;
  numerics::LocalBound whole(double s) const {
    return {s * (a - j * s * s / 6.0), a - 0.5 * j * s * s, -j * s, -j, 1e3, 2e6};
  }
  numerics::LocalBound operator()(double s, double level) const {
    auto bound = whole(s);
    bound.value -= level;
    return bound;
  }
};

TEST(FirstCrossing, OfAGapThatOpensByAFewErrorsAndFallsIsFound) {
  const Hump gap;
  const auto error = [](double) { return 2.5e-13; };
  const auto found = first_crossing(gap, error, 5e-13, 6e-7, 1e-2, 1000000);
  EXPECT_EQ(found.status, Crossing::Status::certain);
  EXPECT_NEAR(found.s, std::sqrt(6.0 * gap.a / gap.j), 1e-20);
}

// least + curvature (s - middle)^2: it has no third derivative.
struct Parabola {
  double least, curvature, middle;
  numerics::LocalBound whole(double s) const {
    const double x = s - middle;
    return {least + curvature * x * x, 2.0 * curvature * x,
            2.0 * curvature,           0.0,
            2.0 * std::abs(curvature), 0.0};
  }
  numerics::LocalBound operator()(double s, double level) const {
    auto bound = whole(s);
    bound.value -= level;
    return bound;
  }
};

TEST(FirstCrossing, OfAParabolaIsFound) {
  const auto found = first_crossing(
      Parabola{2.5e-13, -1.0, 5e-7}, [](double) { return 5e-14; }, 1e-13, 2e-7, 1e-2, 1000000);
  EXPECT_EQ(found.status, Crossing::Status::certain);
  EXPECT_NEAR(found.s, 1e-6, 1e-20);
}

// The errors within the level of the search are smaller at the end, or not.
TEST(FirstCrossing, OfAGapThatIsSmallAfterTheEndIsNoneOrUncertainAtTheEnd) {
  const auto found = [](double error, double until) {
    return first_crossing(
        Parabola{0.004, 1.0, 1.0}, [=](double) { return error; }, 0.02, 0.0, until, 1000);
  };
  EXPECT_EQ(found(0.001, 0.9).status, Crossing::Status::none);
  const auto there = found(0.01, 0.9);
  EXPECT_EQ(there.status, Crossing::Status::uncertain);
  EXPECT_EQ(there.s, 0.9);
  EXPECT_NEAR(there.gap, 0.014, 1e-15);
  EXPECT_NEAR(found(0.01, 2.0).s, 1.0, 0.01);
}

}  // namespace
}  // namespace clackers::exact
