#include "clackers/report/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include "clackers/base/json.hpp"

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

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u; }

// Bytes of the first `width` characters.
std::size_t bytes_of(std::string_view text, std::size_t width) {
  std::size_t i = 0;
  for (std::size_t seen = 0; i < text.size(); ++i)
    if (!is_continuation(text[i]) && seen++ == width) break;
  return i;
}

// Where to break a text longer than `width`: the number of bytes that go on the first line.
std::size_t break_at(std::string_view text, std::size_t width) {
  const auto whole = bytes_of(text, width);
  if (const auto space = text.rfind(' ', whole); space != std::string_view::npos && space > 0)
    return space;
  // In a method's name the joint between integrator and contact is the best place.
  for (const std::string_view marks : {"+", ":,", "_/=-"}) {
    const auto mark = text.find_last_of(marks, whole - 1);
    if (mark != std::string_view::npos && mark > 0) return mark + 1;
  }
  return whole;
}

// "Order    2 for gamma = 1/2": how far the lines below stand to the right, so that the word before
// the wide space stays alone. 0 for other lines.
std::size_t hanging_indent(std::string_view line) {
  constexpr std::size_t longest_word = 16;
  // The longest word of a method's card fills its column but for one space.
  if (constexpr std::string_view filling = "Dissipation "; line.starts_with(filling))
    return filling.size();
  const auto space = line.find("  ");
  if (space == 0 || space > longest_word) return 0;
  const auto text = line.find_first_not_of(' ', space);
  return text == std::string_view::npos ? 0 : display_width(line.substr(0, text));
}

void wrap_line(std::string_view line, std::size_t width, std::vector<std::string>& out) {
  const auto indent = std::min(line.find_first_not_of(' '), line.size());
  auto rest = line.substr(indent);
  const auto hanging = indent + hanging_indent(rest);
  std::string margin(indent < width ? indent : 0, ' ');
  while (display_width(rest) > width - margin.size()) {
    const auto length = break_at(rest, width - margin.size());
    auto head = rest.substr(0, length);
    head = head.substr(0, head.find_last_not_of(' ') + 1);
    out.push_back(margin + std::string(head));
    rest.remove_prefix(length);
    rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    // Where half of the width would be lost the lines below start further left.
    if (2 * hanging < width) margin.assign(hanging, ' ');
  }
  if (!rest.empty() || indent == line.size()) out.push_back(margin + std::string(rest));
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

std::size_t display_width(std::string_view text) {
  return std::size_t(std::ranges::count_if(text, [](char c) { return !is_continuation(c); }));
}

std::vector<std::string> wrap(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  for (std::size_t from = 0; from <= text.size();) {
    const auto to = std::min(text.find('\n', from), text.size());
    wrap_line(text.substr(from, to - from), std::max<std::size_t>(width, 1), lines);
    from = to + 1;
  }
  return lines;
}

std::string rejoin(std::string_view text) {
  std::string joined;
  bool prose = false;  // whether the line before can go on
  for (std::size_t from = 0; from <= text.size();) {
    const auto to = std::min(text.find('\n', from), text.size());
    const auto line = text.substr(from, to - from);
    const bool starts_left = !line.empty() && line.front() != ' ';
    if (from > 0) joined += prose && starts_left && hanging_indent(line) == 0 ? ' ' : '\n';
    joined += line;
    prose = starts_left;
    from = to + 1;
  }
  return joined;
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
