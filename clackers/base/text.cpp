#include "clackers/base/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

namespace clackers {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t length = 0;  ///< bytes; 0: no UTF-8
};

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return {};
  std::uint32_t code = lead & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return {};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  const bool is_overlong = length == 3 ? code < 0x800 : length == 4 && code < 0x10000;
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (is_overlong || is_surrogate || code > 0x10FFFF) return {};
  return {code, length};
}

bool is_control(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code <= 0x9F) || code == 0x61C || code == 0x200E ||
         code == 0x200F || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069) || code == 0xFEFF;
}

bool is_plain(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         std::string_view("_./+-:=@%,").find(c) != std::string_view::npos;
}

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u; }

// Bytes of the first `width` characters.
std::size_t bytes_of(std::string_view text, std::size_t width) {
  std::size_t i = 0;
  for (std::size_t seen = 0; i < text.size(); ++i)
    if (!is_continuation(text[i]) && seen++ == width) break;
  return i;
}

bool is_wider(std::string_view text, std::size_t width) {
  return bytes_of(text, width) < text.size();
}

// Where to break a text longer than `width`: the number of bytes that go on the first line.
std::size_t break_at(std::string_view text, std::size_t width, LongWords long_words) {
  const auto whole = bytes_of(text, width);
  if (const auto space = text.rfind(' ', whole); space != std::string_view::npos && space > 0)
    return space;
  if (long_words == LongWords::kept) return std::min(text.find(' ', whole), text.size());
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

void wrap_line(std::string_view line, std::size_t width, LongWords long_words,
               std::vector<std::string>& out) {
  const auto indent = std::min(line.find_first_not_of(' '), line.size());
  auto rest = line.substr(indent);
  const auto hanging = indent + hanging_indent(rest);
  std::string margin(indent < width ? indent : 0, ' ');
  while (is_wider(rest, width - margin.size())) {
    const auto length = break_at(rest, width - margin.size(), long_words);
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

std::string printable(std::string_view text) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string out;
  while (!text.empty()) {
    const auto character = first_character(text);
    const bool keep = character.length > 0 && !is_control(character.code);
    const std::size_t length = character.length > 0 ? character.length : 1;
    for (const char c : text.substr(0, length)) {
      const auto byte = static_cast<unsigned char>(c);
      if (keep)
        out += c;
      else
        out.append({'\\', 'x', digits[byte >> 4], digits[byte & 15]});
    }
    text.remove_prefix(length);
  }
  return out;
}

std::string shell_quoted(std::string_view word) {
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return std::string(word);
  std::string result = "'";
  for (const char c : word)
    if (c == '\'')
      result += "'\\''";
    else
      result += c;
  return result + "'";
}

std::string shell_line(std::span<const std::string> arguments) {
  std::string line;
  for (const auto& argument : arguments) line += (line.empty() ? "" : " ") + shell_quoted(argument);
  return line;
}

std::vector<std::string> shell_words(std::string_view line) {
  std::vector<std::string> words;
  bool is_quoted = false, is_word = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (!is_quoted && c == ' ') {
      is_word = false;
      continue;
    }
    if (!is_word) words.emplace_back();
    is_word = true;
    if (c == '\'')
      is_quoted = !is_quoted;
    else if (!is_quoted && c == '\\' && i + 1 < line.size())
      words.back() += line[++i];
    else
      words.back() += c;
  }
  return words;
}

std::size_t display_width(std::string_view text) {
  return std::size_t(std::ranges::count_if(text, [](char c) { return !is_continuation(c); }));
}

std::vector<std::string> wrap(std::string_view text, std::size_t width, LongWords long_words) {
  std::vector<std::string> lines;
  for (std::size_t from = 0; from <= text.size();) {
    const auto to = std::min(text.find('\n', from), text.size());
    wrap_line(text.substr(from, to - from), std::max<std::size_t>(width, 1), long_words, lines);
    from = to + 1;
  }
  return lines;
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  return fmt::format("{}", fmt::join(wrap(text, width - indent, LongWords::kept),
                                     '\n' + std::string(indent, ' ')));
}

std::string rejoin(std::string_view text) {
  std::string joined;
  bool prose = false;       // whether the line before can go on
  std::size_t hanging = 0;  // where its paragraph goes on, below "Order    "
  for (std::size_t from = 0; from <= text.size();) {
    const auto to = std::min(text.find('\n', from), text.size());
    auto line = text.substr(from, to - from);
    if (hanging > 0 && line.find_first_not_of(' ') == hanging) line.remove_prefix(hanging);
    const bool starts_left = !line.empty() && line.front() != ' ';
    const bool is_term = hanging_indent(line) > 0;
    if (from > 0) joined += prose && starts_left && !is_term ? ' ' : '\n';
    joined += line;
    prose = starts_left;
    if (is_term || !starts_left) hanging = hanging_indent(line);
    from = to + 1;
  }
  return joined;
}

}  // namespace clackers
