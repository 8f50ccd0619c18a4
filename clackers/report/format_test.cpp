#include "clackers/report/format.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "clackers/base/text.hpp"

namespace clackers::report {
namespace {

TEST(Format, ExactNumbersReadBackToTheSameDouble) {
  std::mt19937_64 bits(20251121);
  for (int i = 0; i < 20000; ++i) {
    const auto value = std::bit_cast<double>(bits());
    if (!std::isfinite(value)) continue;
    ASSERT_EQ(std::strtod(exact_number(value).c_str(), nullptr), value) << "seed 20251121, " << i;
  }
  EXPECT_EQ(exact_number(0.1), "0.1");
  EXPECT_EQ(exact_number(-0.0), "-0");
  EXPECT_EQ(exact_number(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(exact_number(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(exact_number(std::nan("")), "nan");
}

TEST(Format, ShortNumbersGiveUpDigitsButNeverTheirSize) {
  EXPECT_EQ(short_number(0.998749217771909), "0.998749");
  EXPECT_EQ(short_number(2.0), "2");
  EXPECT_EQ(short_number(-1.23456789e-7), "-1.23457e-7");
  EXPECT_EQ(short_number(-1.23456789e-7, 6, 9), "-1.235e-7");
  EXPECT_EQ(short_number(-1.23456789e-107, 6, 7), "-1e-107");
  EXPECT_EQ(short_number(6.02e23), "6.02e23");
  EXPECT_EQ(short_number(1e100), "1e100");
}

TEST(Format, ScientificNumbersLineUp) {
  EXPECT_EQ(scientific(1.234e-7), "1.2e-7");
  EXPECT_EQ(scientific(1.0), "1.0e0");
  EXPECT_EQ(scientific(1.234e-10, 3), "1.234e-10");
  EXPECT_EQ(scientific(0.0), "0");
  EXPECT_EQ(scientific(std::nan("")), "-");
}

TEST(Format, CountsTakeAtMostFiveCharacters) {
  EXPECT_EQ(short_count(0), "0");
  EXPECT_EQ(short_count(99999), "99999");
  EXPECT_EQ(short_count(163840), "164k");
  EXPECT_EQ(short_count(999499), "999k");
  EXPECT_EQ(short_count(999500), "1.0M");
  EXPECT_EQ(short_count(99949999), "99.9M");
  EXPECT_EQ(short_count(99950000), "100M");
  EXPECT_EQ(short_count(8000000000), "8.0G");
  for (long long n = 1; n < 4'000'000'000'000'000'000; n = n * 3 + 1)
    EXPECT_LE(short_count(n).size(), 5u) << n;
}

TEST(Format, WidthIsCountedInCharactersNotBytes) {
  EXPECT_EQ(display_width("2.00±0.01"), 9u);
  EXPECT_EQ(pad("±", 3, true), "  ±");
  EXPECT_EQ(pad("±", 3, false), "±  ");
  EXPECT_EQ(pad("long", 3, true), "long");
}

}  // namespace
}  // namespace clackers::report
