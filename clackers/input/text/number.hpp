#pragma once

#include <optional>
#include <string_view>

namespace clackers::input {

/// A number as it is printed.
struct Number {
  double value = 0.0;
  int digits = 0;  ///< printed significant digits, trailing zeros included; 0 for zero
};

/// Why a text is no number that can be used.
enum class NumberError { none, no_number, not_finite, decimal_comma };

/// Reads a decimal number with a point: "1.5", "-1.5e-3", "+.5", and Fortran's "1.5D-3". Returns
/// what is wrong with any other text; NaN, infinities and what a double cannot hold are not_finite.
NumberError read(std::string_view text, Number& number);

/// Whether the text is a number, NaN and infinity included. A header has none.
bool looks_numeric(std::string_view text);

}  // namespace clackers::input
