#include "clackers/numerics/golden_section.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clackers::numerics {
namespace {

TEST(GoldenSection, LeastValueIsFoundInsideAndAtTheEndsOfTheInterval) {
  for (const double place : {-0.7, 0.0, 0.31, 2.0}) {
    int calls = 0;
    const auto least = golden_section(-1.0, 1.0, 40, [&](double x) {
      ++calls;
      return std::abs(x - place) + 3.0;
    });
    EXPECT_NEAR(least.x, std::min(place, 1.0), 2.0 * std::pow(0.6180339887498949, 40)) << place;
    EXPECT_EQ(least.value, std::abs(least.x - place) + 3.0);
    EXPECT_EQ(calls, 42);
  }
}

}  // namespace
}  // namespace clackers::numerics
