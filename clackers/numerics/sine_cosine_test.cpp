#include "clackers/numerics/sine_cosine.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace clackers::numerics {
namespace {

TEST(SineCosine, ErrsByHalfAUnitOfOneAtMostForEveryArgument) {
  std::mt19937_64 generator(20180501);
  for (const double most : {0.5, 1.0, 3.0, 100.0, 1e4, 7.9e5, 1e7}) {
    std::uniform_real_distribution<double> any(-most, most);
    for (int i = 0; i < 5000; ++i) {
      const double x = any(generator);
      const auto [sine, cosine] = sine_cosine(x);
      ASSERT_NEAR(double(sine - std::sin((long double)(x))), 0.0, 0x1p-52) << x;
      ASSERT_NEAR(double(cosine - std::cos((long double)(x))), 0.0, 0x1p-52) << x;
    }
  }
}

TEST(SineCosine, OfMultiplesOfAQuarterTurnHasTheRightSigns) {
  for (int k = -9; k <= 9; ++k) {
    const double x = k * 1.5707963267948966;
    EXPECT_NEAR(sine_cosine(x).sine, std::sin(x), 0x1p-52);
    EXPECT_NEAR(sine_cosine(x).cosine, std::cos(x), 0x1p-52);
  }
  EXPECT_EQ(sine_cosine(0.0).sine, 0.0);
  EXPECT_EQ(sine_cosine(0.0).cosine, 1.0);
  EXPECT_TRUE(std::isnan(sine_cosine(std::numeric_limits<double>::infinity()).sine));
}

}  // namespace
}  // namespace clackers::numerics
