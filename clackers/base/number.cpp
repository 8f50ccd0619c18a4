#include "clackers/base/number.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace clackers {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Of a number; all letters stand behind the digits in ASCII. Called for each number of a file.
int significant_digits(std::string_view text) {
  const char *at = text.data(), *const end = at + text.size();
  while (at != end && (*at == '-' || *at == '0' || *at == '.')) ++at;
  const char* const first = at;
  int points = 0;
  for (; at != end && *at <= '9'; ++at) points += *at == '.';
  return int(at - first) - points;
}

constexpr auto powers_of_five = [] {
  std::array<std::uint64_t, 28> powers{1};  // all that fit
  for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = 5 * powers[i - 1];
  return powers;
}();

// The double nearest to whole / 10^k for whole > 0. The quotient has 62 bits at least, of which a double keeps
// 53; its last bit is set where the division leaves a remainder, so that rounding sees it.
double quotient(std::uint64_t whole, std::size_t k) {
  __extension__ using Wide = unsigned __int128;
  const int up = std::countl_zero(whole), down = std::countl_zero(powers_of_five[k]);
  const Wide above = Wide{whole << up} << 63, below = Wide{powers_of_five[k] << down};
  const auto ratio = static_cast<std::uint64_t>(above / below);
  const bool has_remainder = ratio * below != above;
  // At least 2^-153, so that no product is subnormal.
  const auto power = static_cast<std::uint64_t>(1023 + down - up - 63 - int(k)) << 52;
  return double(ratio | std::uint64_t{has_remainder}) * std::bit_cast<double>(power);
}

// The eight digits at `at` as a number; false where one of them is no digit.
bool read_eight(const char* at, std::uint64_t& number) {
  std::uint64_t x;
  std::memcpy(&x, at, sizeof x);
  constexpr std::uint64_t high = 0xF0F0F0F0F0F0F0F0, zeros = 0x3030303030303030;
  if ((x & high) != zeros || ((x + 0x0606060606060606) & high) != zeros) return false;
  // Neighbours are joined to numbers of two, four and eight digits; the first stands lowest.
  x = (x - zeros) * 10 + ((x - zeros) >> 8);
  constexpr std::uint64_t pairs = 0x000000FF000000FF;
  number = ((x & pairs) * 0x000F424000000064 + ((x >> 16) & pairs) * 0x0000271000000001) >> 32;
  return true;
}

// A number of at most 19 digits and 27 decimals, such as "-1.5e-3". False for any other text, which may
// be a number all the same.
bool read_short(std::string_view text, Number& number) {
  constexpr int most_digits = 19;  // of a std::uint64_t
  const char *at = text.data(), *const end = at + text.size(), *point = nullptr;
  const bool is_negative = text.starts_with('-');
  if (is_negative) ++at;
  const char* const first = at;
  std::uint64_t whole = 0;
  int digits = 0;
  for (; at != end; ++at) {
    std::uint64_t next = 0;
    while (std::endian::native == std::endian::little && whole != 0 && end - at >= 8 &&
           read_eight(at, next)) {
      whole = 100'000'000 * whole + next;
      digits += 8;
      at += 8;
    }
    if (at == end) break;
    if (is_digit(*at)) {
      whole = 10 * whole + static_cast<std::uint64_t>(*at - '0');
      digits += whole != 0;
    } else if (*at == '.' && point == nullptr) {
      point = at;
    } else {
      break;
    }
  }
  if (digits > most_digits || at - first == (point != nullptr)) return false;
  const auto decimals = point == nullptr ? 0 : at - point - 1;
  int exponent = 0;
  if (at != end) {
    if ((*at != 'e' && *at != 'E') || ++at == end) return false;
    const bool has_plus = *at == '+';
    const auto [stop, error] = std::from_chars(at + has_plus, end, exponent);
    if (error != std::errc() || stop != end || (has_plus && at[1] == '-')) return false;
  }
  const auto k = decimals - exponent;
  if (k < 0 || k >= std::ssize(powers_of_five)) return false;
  const double size = whole == 0 ? 0.0 : quotient(whole, std::size_t(k));
  number = {is_negative ? -size : size, digits};
  return true;
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

// "1.2e-07" as "1.2e-7": the zero and the plus sign carry nothing and cost the width of a column.
std::string without_padding(std::string text) {
  const auto e = text.find('e');
  if (e == std::string::npos) return text;
  std::size_t digits = e + 1;
  if (text[digits] == '+') text.erase(digits, 1);
  if (text[digits] == '-') ++digits;
  while (text[digits] == '0' && digits + 1 < text.size()) text.erase(digits, 1);
  return text;
}

}  // namespace

NumberError read_decimal(std::string_view text, Number& number) {
  const auto whole = text;
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  if (read_short(text, number)) return NumberError::none;
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

NumberError read_number(std::string_view text, double& value) {
  const auto slash = text.find('/');
  Number above, below{1.0};
  auto error = read_decimal(text.substr(0, slash), above);
  if (error == NumberError::none && slash != std::string_view::npos)
    error = read_decimal(text.substr(slash + 1), below);
  value = above.value / below.value;
  return error == NumberError::none && !std::isfinite(value) ? NumberError::not_finite : error;
}

std::optional<double> finite_number(std::string_view text) {
  double value = 0.0;
  if (read_number(text, value) != NumberError::none) return {};
  return value;
}

std::optional<long long> whole_number(std::string_view text) {
  long long value = 0;
  const auto end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return {};
  return value;
}

bool looks_numeric(std::string_view text) {
  double value = 0.0;
  return read_number(text, value) != NumberError::no_number;
}

double rounded(double value, int digits) {
  if (!std::isfinite(value)) return value;
  const auto text = fmt::format("{:.{}e}", value, digits - 1);
  double out = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), out);
  // Of the largest doubles six digits may be beyond all doubles.
  return read.ec == std::errc() ? out : value;
}

std::string exact_number(double value) { return fmt::format("{}", value); }

std::string short_number(double value, int digits, std::size_t width) {
  std::string text;
  for (int kept = digits; kept >= 1; --kept) {
    text = without_padding(fmt::format("{:.{}g}", value, kept));
    if (text.size() <= width) break;
  }
  return text;
}

std::string scientific(double value, int decimals) {
  if (std::isnan(value)) return "-";
  if (value == 0.0) return "0";
  return without_padding(fmt::format("{:.{}e}", value, decimals));
}

std::string short_count(long long value) {
  if (std::llabs(value) < 100000) return fmt::format("{}", value);
  constexpr std::string_view prefixes = "kMGTPE";
  double scaled = double(value);
  std::size_t prefix = 0;
  // 999.5 would be rounded up to four digits.
  for (scaled /= 1000.0; std::abs(scaled) >= 999.5; scaled /= 1000.0) ++prefix;
  const bool whole = std::abs(scaled) >= 99.95;
  return fmt::format("{:.{}f}{}", scaled, whole ? 0 : 1, prefixes[prefix]);
}

}  // namespace clackers
