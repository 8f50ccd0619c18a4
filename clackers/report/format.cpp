#include "clackers/report/format.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "clackers/base/json.hpp"
#include "clackers/base/text.hpp"

namespace clackers::report {
namespace {

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

std::string pad(std::string_view text, std::size_t width, bool to_the_right) {
  const auto used = display_width(text);
  const std::string space(width > used ? width - used : 0, ' ');
  return to_the_right ? space + std::string(text) : std::string(text) + space;
}

std::string xml_text(std::string_view text) {
  constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD
  std::string out;
  for (const char c : valid_utf8(text)) {
    const bool is_control = c >= 0 && c < ' ' && c != '\t' && c != '\n' && c != '\r';
    if (is_control)
      out += replacement;
    else
      out += c;
  }
  for (const std::string_view excluded : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})
    for (auto at = out.find(excluded); at != std::string::npos; at = out.find(excluded, at))
      out.replace(at, excluded.size(), replacement);
  return out;
}

}  // namespace clackers::report
