#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/number.hpp"

namespace clackers::input {

/// How many digits a column of numbers is printed with, and what that hides.
///
/// The most significant digits that any of its numbers has count: formats such as C's %g drop
/// trailing zeros of some numbers, and fixed decimals give the largest numbers most digits. Either
/// way the last digit of the largest number has the same unit.
class PrintedDigits {
 public:
  void take(const Number& number) {
    digits_ = std::max(digits_, number.digits);
    largest_ = std::max(largest_, std::abs(number.value));
    if (single_) single_ = is_float(number.value);
  }

  /// 0 for a column of zeros.
  int digits() const { return digits_; }
  /// More digits are printed than a float has, yet every number is one.
  bool single_precision() const { return single_ && digits_ > 9; }
  /// Largest rounding error of a number of the column by printing, or by single precision, in the
  /// column's unit; 0 when a double is printed whole (17 digits).
  double half_unit() const;

 private:
  static bool is_float(double value) {
    return std::abs(value) <= double(std::numeric_limits<float>::max()) &&
           double(float(value)) == value;
  }

  int digits_ = 0;
  double largest_ = 0.0;
  bool single_ = true;
};

}  // namespace clackers::input
