#include "clackers/diagnose/file/single_numbers.hpp"

#include <gtest/gtest.h>

#include <random>

#include "clackers/diagnose/testing/histories.hpp"

namespace clackers::diagnose {
namespace {

std::vector<double> numbers(int count) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> any(-3.0, 3.0);
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(any(generator));
  return all;
}

TEST(SingleNumbers, AreKnownInBinaryAndInDecimalForm) {
  for (const int digits : {8, 9, 17}) {
    auto all = numbers(200);
    // 9 digits identify a number of single precision; with 8 of them some are not its nearest.
    for (double& x : all) x = testing::printed(double(float(x)), digits);
    if (digits > 8) {
      EXPECT_TRUE(are_single(all)) << digits;
    }
    all = numbers(200);
    for (double& x : all) x = testing::printed(x, digits);
    EXPECT_FALSE(are_single(all)) << digits;
  }
}

TEST(SingleNumbers, AreNotShortDecimals) {
  for (const int digits : {2, 4, 6}) {
    auto all = numbers(200);
    for (double& x : all) x = testing::printed(x, digits);
    EXPECT_FALSE(are_single(all)) << digits;
  }
  std::vector<double> eighths;
  for (int i = 0; i < 200; ++i) eighths.push_back(0.125 * i);
  EXPECT_FALSE(are_single(eighths));
}

TEST(SingleNumbers, MayBeOneColumnOfTwo) {
  auto all = numbers(200);
  for (std::size_t i = 1; i < all.size(); i += 2) all[i] = double(float(all[i]));
  EXPECT_FALSE(are_single(all, 0, 2));
  EXPECT_TRUE(are_single(all, 1, 2));
}

}  // namespace
}  // namespace clackers::diagnose
