#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

// The grammar of numbers that people write, and numbers as text.
namespace clackers {

/// A number as it is printed.
struct Number {
  double value = 0.0;
  int digits = 0;  ///< printed significant digits, trailing zeros included; 0 for zero
};

/// Why a text is no number that can be used.
enum class NumberError { none, no_number, not_finite, decimal_comma };

/// Reads a decimal number with a point: "1.5", "-1.5e-3", "+.5", and Fortran's "1.5D-3". Returns
/// what is wrong with any other text; NaN, infinities and what a double cannot hold are not_finite.
NumberError read_decimal(std::string_view text, Number& number);

/// The same, and a fraction of two such numbers: "1/9". Sets `value` also to the NaN or infinity that
/// the text names.
NumberError read_number(std::string_view text, double& value);

/// The finite number of read_number(); nothing for any other text.
std::optional<double> finite_number(std::string_view text);

/// The whole number that is all of `text`, in digits and perhaps a minus sign; nothing for any other
/// text.
std::optional<long long> whole_number(std::string_view text);

/// Whether read_number() finds a number, NaN and infinity included. A header has none.
bool looks_numeric(std::string_view text);

/// The nearest number of so many significant decimal digits.
double rounded(double value, int digits = 6);

/// The shortest text that reads back to the same double; "inf", "-inf", "nan" where there is none.
std::string exact_number(double value);

/// For a person: at most `digits` significant digits, fewer where the text would be longer than
/// `width` characters. One digit with its exponent is the least, so 7 characters are always enough.
std::string short_number(double value, int digits = 6, std::size_t width = 32);

/// For a person who compares columns: one digit before the point and `decimals` after it, as in
/// "1.2e-7". "-" for NaN, which stands for "not measured".
std::string scientific(double value, int decimals = 1);

/// A whole number in at most five characters: 81920, 164k, 5.2M.
std::string short_count(long long value);

}  // namespace clackers
