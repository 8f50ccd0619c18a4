#include "clackers/exact/flights/first_crossing.hpp"

#include <gtest/gtest.h>

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

// A parabola has no third derivative.
TEST(FirstCrossing, OfAParabolaIsFound) {
  struct Parabola : Hump {
    numerics::LocalBound whole(double s) const {
      return {s * (1e-6 - s), 1e-6 - 2.0 * s, -2.0, 0.0, 2.0, 0.0};
    }
    numerics::LocalBound operator()(double s, double level) const {
      auto bound = whole(s);
      bound.value -= level;
      return bound;
    }
  };
  const auto found = first_crossing(
      Parabola(), [](double) { return 5e-14; }, 1e-13, 2e-7, 1e-2, 1000000);
  EXPECT_EQ(found.status, Crossing::Status::certain);
  EXPECT_NEAR(found.s, 1e-6, 1e-20);
}

}  // namespace
}  // namespace clackers::exact
