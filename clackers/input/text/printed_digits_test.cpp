#include "clackers/input/text/printed_digits.hpp"

#include <gtest/gtest.h>

namespace clackers::input {
namespace {

Number number(std::string_view text) {
  Number out;
  EXPECT_EQ(read_decimal(text, out), NumberError::none) << text;
  return out;
}

PrintedDigits column(std::initializer_list<std::string_view> texts) {
  PrintedDigits digits;
  for (const auto text : texts) digits.take(number(text));
  return digits;
}

TEST(PrintedDigits, OfGeneralFormatAreThoseOfTheLongestNumber) {
  // %g drops the zeros of 0.5 and 1.
  const auto digits = column({"1", "0.5", "0.123457", "-0.00123457"});
  EXPECT_EQ(digits.digits(), 6);
  // The last of six digits of a number between 1 and 10 is 1e-5.
  EXPECT_DOUBLE_EQ(digits.half_unit(), 0.5e-5);
}

TEST(PrintedDigits, OfFixedDecimalsHaveTheUnitOfTheLastDecimal) {
  const auto digits = column({"0.0012", "-12.3456", "1.0000"});
  EXPECT_EQ(digits.digits(), 6);
  EXPECT_DOUBLE_EQ(digits.half_unit(), 0.5e-4);
}

TEST(PrintedDigits, HideNothingOfAWholeDoubleOrOfZeros) {
  EXPECT_EQ(column({"0.12345678901234567"}).half_unit(), 0.0);
  EXPECT_GT(column({"0.1234567890123456"}).half_unit(), 0.0);
  EXPECT_EQ(column({"0", "0.000"}).half_unit(), 0.0);
}

TEST(PrintedDigits, KnowSinglePrecisionByItsNumbers) {
  const auto floats = column({"0.10000000149011612", "0.5", "3.1415927410125732"});
  EXPECT_TRUE(floats.single_precision());
  EXPECT_DOUBLE_EQ(floats.half_unit(), 3.1415927410125732 * 0x1p-24);
  EXPECT_FALSE(column({"0.10000000149011612", "0.1"}).single_precision());
  // Few digits say nothing of precision: all of these are floats.
  EXPECT_FALSE(column({"0.5", "0.25"}).single_precision());
}

}  // namespace
}  // namespace clackers::input
