#include "clackers/base/number.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

namespace clackers {
namespace {

Number number(std::string_view text) {
  Number out;
  EXPECT_EQ(read_decimal(text, out), NumberError::none) << text;
  return out;
}

NumberError error_of(std::string_view text) {
  Number out;
  return read_decimal(text, out);
}

TEST(Number, IsReadAsPrograms) {
  EXPECT_EQ(number("1.5").value, 1.5);
  EXPECT_EQ(number("+1.5e-3").value, 1.5e-3);
  EXPECT_EQ(number("-.5").value, -0.5);
  EXPECT_EQ(number("7.").value, 7.0);
  EXPECT_EQ(number("-1.25D-03").value, -1.25e-3);
  EXPECT_EQ(number("1.d2").value, 100.0);
}

TEST(Number, IsTheNearestDouble) {
  const auto expect_nearest = [](const std::string& text) {
    const auto found = number(text).value;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(found),
              std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)))
        << text;
  };
  std::mt19937_64 random(20261127);  // NOLINT: the same numbers in every run
  for (int i = 0; i < 100000; ++i) {
    auto text = std::to_string(random() >> random() % 64);
    if (random() % 2 == 0) text.insert(random() % (text.size() + 1), ".");
    if (random() % 2 == 0) text.insert(0, random() % 2 == 0 ? "-" : "0");
    expect_nearest(text);
    expect_nearest(text + "e" + std::to_string(int(random() % 70) - 60));
    expect_nearest(text + "E+" + std::to_string(random() % 20));
  }
  // Half way between two doubles, and next to it.
  for (int i = 0; i < 10000; ++i) {
    const auto half_way = (std::uint64_t{1} << 53) + (random() >> 11) + 1;
    for (std::uint64_t five = 1, k = 0; k <= 3; five *= 5, ++k)
      for (const auto whole : {five * half_way - 1, five * half_way, five * half_way + 1})
        expect_nearest(std::to_string(whole) + "e-" + std::to_string(k));
  }
  for (const auto* text : {"0", "-0", "-0.000e5", "9007199254740993", "9999999999999999999"})
    expect_nearest(text);
  for (const auto* text : {"1e+-0", "1e", "1e+", "-", ".", "1.2.3", "1e5x", "--1"})
    EXPECT_EQ(error_of(text), NumberError::no_number) << text;
}

TEST(Number, MayNotHoldAnyOtherCharacterAmongItsDigits) {
  const std::string digits = "1234567890123456789";
  for (std::size_t at = 1; at < digits.size(); ++at)
    for (int c = 0; c < 256; ++c) {
      auto text = digits;
      text[at] = static_cast<char>(c);
      const bool is_number = (c >= '0' && c <= '9') || c == '.';
      if (c == 'e' || c == 'E' || c == 'd' || c == 'D') continue;  // a number, though a large one
      if (c == ',' || c == '/') continue;
      EXPECT_EQ(error_of(text) == NumberError::none, is_number) << text;
    }
}

TEST(Number, CountsItsSignificantDigits) {
  EXPECT_EQ(number("0.00123").digits, 3);
  EXPECT_EQ(number("-1.230").digits, 4);
  EXPECT_EQ(number("1.2345E-10").digits, 5);
  EXPECT_EQ(number("6.02d23").digits, 3);
  EXPECT_EQ(number("100").digits, 3);
  EXPECT_EQ(number("0.000").digits, 0);
  EXPECT_EQ(number("0.10000000000000001").digits, 17);
}

TEST(Number, SaysWhatIsWrongWithOtherText) {
  EXPECT_EQ(error_of("abc"), NumberError::no_number);
  EXPECT_EQ(error_of(""), NumberError::no_number);
  EXPECT_EQ(error_of("1.5x"), NumberError::no_number);
  EXPECT_EQ(error_of("+-1"), NumberError::no_number);
  EXPECT_EQ(error_of("d2"), NumberError::no_number);
  EXPECT_EQ(error_of("1d"), NumberError::no_number);
  EXPECT_EQ(error_of("nan"), NumberError::not_finite);
  EXPECT_EQ(error_of("-Inf"), NumberError::not_finite);
  EXPECT_EQ(error_of("1e999"), NumberError::not_finite);
  EXPECT_EQ(error_of("0,05"), NumberError::decimal_comma);
  EXPECT_EQ(error_of("u,v"), NumberError::no_number);
}

TEST(Number, LooksNumericThoughItIsNotFinite) {
  EXPECT_TRUE(looks_numeric("nan"));
  EXPECT_TRUE(looks_numeric("0,5"));
  EXPECT_FALSE(looks_numeric("time"));
  EXPECT_FALSE(looks_numeric("-"));
}

TEST(Number, MayBeAFraction) {
  EXPECT_EQ(finite_number("1/4"), 0.25);
  EXPECT_EQ(finite_number("-1e1/+2.5"), -4.0);
  EXPECT_EQ(finite_number("0.05"), 0.05);
  for (const auto* text :
       {"", "/", "1/", "/2", "1/2/3", "1/x", "1/0", "0/0", "1/nan", "inf", "1 /2"})
    EXPECT_FALSE(finite_number(text)) << text;
  double value = 0.0;
  EXPECT_EQ(read_number("1/0", value), NumberError::not_finite);
  EXPECT_EQ(read_number("-inf", value), NumberError::not_finite);
  EXPECT_EQ(value, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(read_number("1/0,5", value), NumberError::decimal_comma);
}

TEST(Number, WholeOnesAreAllOfTheirText) {
  EXPECT_EQ(whole_number("-12"), -12);
  EXPECT_EQ(whole_number("9223372036854775807"), 9223372036854775807);
  for (const auto* text : {"", "1.5", "1e3", " 1", "1 ", "9223372036854775808"})
    EXPECT_FALSE(whole_number(text)) << text;
}

TEST(Rounded, AnyDoubleHasSixDigits) {
  EXPECT_EQ(rounded(1.23456789), 1.23457);
  EXPECT_EQ(rounded(5e-324), 5e-324);
  EXPECT_EQ(rounded(-4.247828255331e-311), -4.24783e-311);
  EXPECT_TRUE(std::isfinite(rounded(std::numeric_limits<double>::max())));
  EXPECT_EQ(rounded(INFINITY), INFINITY);
}

TEST(NumberText, ExactNumbersReadBackToTheSameDouble) {
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

TEST(NumberText, ShortNumbersGiveUpDigitsButNeverTheirSize) {
  EXPECT_EQ(short_number(0.998749217771909), "0.998749");
  EXPECT_EQ(short_number(2.0), "2");
  EXPECT_EQ(short_number(-1.23456789e-7), "-1.23457e-7");
  EXPECT_EQ(short_number(-1.23456789e-7, 6, 9), "-1.235e-7");
  EXPECT_EQ(short_number(-1.23456789e-107, 6, 7), "-1e-107");
  EXPECT_EQ(short_number(6.02e23), "6.02e23");
  EXPECT_EQ(short_number(1e100), "1e100");
}

TEST(NumberText, ScientificNumbersLineUp) {
  EXPECT_EQ(scientific(1.234e-7), "1.2e-7");
  EXPECT_EQ(scientific(1.0), "1.0e0");
  EXPECT_EQ(scientific(1.234e-10, 3), "1.234e-10");
  EXPECT_EQ(scientific(0.0), "0");
  EXPECT_EQ(scientific(std::nan("")), "-");
}

TEST(NumberText, CountsTakeAtMostFiveCharacters) {
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

}  // namespace
}  // namespace clackers
