#include "clackers/report/format.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "clackers/base/files/json.hpp"
#include "clackers/base/text.hpp"

namespace clackers::report {
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
