#include "clackers/input/text/number.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace clackers::input {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

int significant_digits(std::string_view text) {
  int count = 0;
  for (const char c : text) {
    if (is_digit(c))
      count += count > 0 || c != '0';
    else if (c != '.' && c != '-')
      break;
  }
  return count;
}

// "1.5D-3" as "1.5E-3" in `copy`; the text itself when there is no such exponent.
std::string_view without_d(std::string_view text, std::array<char, 64>& copy) {
  const auto at = text.find_first_of("dD");
  if (at == std::string_view::npos || at == 0 || text.size() > copy.size()) return text;
  if (!is_digit(text[at - 1]) && text[at - 1] != '.') return text;
  text.copy(copy.data(), text.size());
  copy[at] = 'e';
  return {copy.data(), text.size()};
}

bool has_decimal_comma(std::string_view text) {
  const auto comma = text.find(',');
  return comma != std::string_view::npos && comma > 0 && is_digit(text[comma - 1]) &&
         text.find_first_not_of("0123456789+-eEdD,") == std::string_view::npos;
}

}  // namespace

NumberError read(std::string_view text, Number& number) {
  const auto whole = text;
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto try_read = [&number](std::string_view s) {
    const auto [stop, error] = std::from_chars(s.data(), s.data() + s.size(), number.value);
    if (stop != s.data() + s.size() || error == std::errc::invalid_argument)
      return NumberError::no_number;
    if (error == std::errc::result_out_of_range || !std::isfinite(number.value))
      return NumberError::not_finite;
    return NumberError::none;
  };
  auto result = try_read(text);
  if (result == NumberError::no_number) {
    std::array<char, 64> copy;
    result = try_read(without_d(text, copy));
  }
  if (result == NumberError::no_number && has_decimal_comma(whole))
    return NumberError::decimal_comma;
  if (result == NumberError::none) number.digits = significant_digits(text);
  return result;
}

bool looks_numeric(std::string_view text) {
  Number number;
  return read(text, number) != NumberError::no_number;
}

}  // namespace clackers::input
