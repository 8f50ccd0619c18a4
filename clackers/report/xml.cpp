#include "clackers/report/xml.hpp"

#include <fmt/format.h>

#include "clackers/report/utf8.hpp"

namespace clackers::report {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

std::string escaped(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&apos;";
    case '\r':  // bare, it would be read as a line feed
      return "&#13;";
    case '\n':
    case '\t':
      return std::string(1, c);
    default:
      return (c >= 0 && c < ' ') ? std::string(replacement) : std::string(1, c);
  }
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string out;
  for (const char c : valid_utf8(text)) out += escaped(c);
  // The two code points of UTF-8 that xml 1.0 excludes: U+FFFE and U+FFFF.
  for (const std::string_view forbidden : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})
    for (auto at = out.find(forbidden); at != std::string::npos; at = out.find(forbidden, at))
      out.replace(at, forbidden.size(), replacement);
  return out;
}

std::string xml_attribute(std::string_view name, std::string_view value) {
  std::string text;
  for (const char c : xml_text(value))
    text += c == '\n' ? "&#10;" : c == '\t' ? "&#9;" : std::string(1, c);
  return fmt::format(" {}=\"{}\"", name, text);
}

}  // namespace clackers::report
