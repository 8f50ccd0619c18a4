#include "clackers/report/markup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "clackers/base/files/json.hpp"
#include "clackers/report/format.hpp"

namespace clackers::report {
namespace {

// "1.2e-07" as "1.2 × 10<sup>−7</sup>", "-0.5" with a true minus sign.
std::string with_power(const std::string& text) {
  const auto e = text.find('e');
  auto mantissa = text.substr(0, e);
  if (mantissa.front() == '-') mantissa.replace(0, 1, "−");
  if (e == std::string::npos) return mantissa;
  const int exponent = std::stoi(text.substr(e + 1));
  return fmt::format("{}\u202f×\u202f10<sup>{}{}</sup>", mantissa, exponent < 0 ? "−" : "",
                     std::abs(exponent));
}

std::string not_finite(double value) { return std::isnan(value) ? "–" : value > 0.0 ? "∞" : "−∞"; }

}  // namespace

std::string escape(std::string_view text) {
  std::string out;
  for (const char c : valid_utf8(text)) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string breakable(const std::string& escaped) {
  std::string out;
  for (const char c : escaped) {
    out += c;
    if (c == '+' || c == ':') out += "<wbr>";
  }
  return out;
}

std::string script_json(const nlohmann::ordered_json& json) {
  const auto text = json_text(json);
  std::string out;
  out.reserve(text.size());
  // "<" occurs inside texts only, where json allows this escape.
  for (const char c : text)
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  return out;
}

std::string html_number(double value, int digits) {
  if (!std::isfinite(value)) return not_finite(value);
  return with_power(fmt::format("{:.{}g}", value, digits));
}

std::string html_scientific(double value, int decimals) {
  if (!std::isfinite(value)) return not_finite(value);
  if (value == 0.0) return "0";
  return with_power(fmt::format("{:.{}e}", value, decimals));
}

std::string html_count(long long value) {
  auto digits = fmt::format("{}", value);
  const std::string sign = value < 0 ? "−" : "";
  if (value < 0) digits.erase(0, 1);
  for (auto at = static_cast<long long>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(std::size_t(at), "\u202f");
  return sign + digits;
}

std::string fill(std::string_view page,
                 const std::vector<std::pair<std::string_view, std::string>>& values) {
  std::string out;
  while (true) {
    const auto open = page.find("{{");
    out += page.substr(0, open);
    if (open == std::string_view::npos) return out;
    const auto close = page.find("}}", open);
    const auto name = page.substr(open + 2, close - open - 2);
    const auto value =
        std::ranges::find(values, name, &std::pair<std::string_view, std::string>::first);
    if (value == values.end())
      throw std::logic_error("page.html: no value for {{" + std::string(name) + "}}");
    out += value->second;
    page.remove_prefix(close + 2);
  }
}

}  // namespace clackers::report
