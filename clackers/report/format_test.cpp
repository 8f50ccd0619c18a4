#include "clackers/report/format.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

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

TEST(Format, WrapsAtSpacesThenAtMarksThenAnywhere) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(wrap("one two three", 7), (Lines{"one two", "three"}));
  EXPECT_EQ(wrap("generalized-alpha:rho=0.8", 13), (Lines{"generalized-", "alpha:rho=0.8"}));
  EXPECT_EQ(wrap("newmark+event-driven", 15), (Lines{"newmark+", "event-driven"}));
  EXPECT_EQ(wrap("abcdefgh", 3), (Lines{"abc", "def", "gh"}));
  EXPECT_EQ(wrap("±±±±", 3), (Lines{"±±±", "±"}));
  EXPECT_EQ(wrap("exact", 5), (Lines{"exact"}));
  EXPECT_EQ(wrap("", 5), (Lines{""}));
}

TEST(Format, KeepsLinesAndTheirIndentation) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(wrap("a\n\n  u1 = u0 + h v0", 80), (Lines{"a", "", "  u1 = u0 + h v0"}));
  EXPECT_EQ(wrap("  one two", 6), (Lines{"  one", "  two"}));
  EXPECT_EQ(wrap("Order  2 for all steps", 15),
            (Lines{"Order  2 for", "       all", "       steps"}));
  EXPECT_EQ(wrap("Order  2 for all steps", 14), (Lines{"Order  2 for", "all steps"}));
}

TEST(Format, RejoinsTheLinesOfAParagraphAndNoOthers) {
  EXPECT_EQ(rejoin("one\ntwo\nthree"), "one two three");
  EXPECT_EQ(rejoin("one\n\ntwo"), "one\n\ntwo");
  EXPECT_EQ(rejoin("one\n    u = v\n    v = a\ntwo"), "one\n    u = v\n    v = a\ntwo");
  EXPECT_EQ(rejoin("Order    2\nSource   a book\n(1991)."), "Order    2\nSource   a book (1991).");
  EXPECT_EQ(rejoin("Order       2\nDissipation none\nMemory      a0"),
            "Order       2\nDissipation none\nMemory      a0");
  EXPECT_EQ(rejoin(""), "");
}

TEST(Format, NoLineIsWiderThanAsked) {
  const std::string text =
      "A sentence, with words such as generalized-alpha:rho=0.8+event-driven and ±±±±±±±±±±±±±±.";
  for (std::size_t width = 1; width < 100; ++width)
    for (const auto& line : wrap(text, width)) EXPECT_LE(display_width(line), width);
}

}  // namespace
}  // namespace clackers::report
