#include "clackers/report/latex/tex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "clackers/base/files/json.hpp"
#include "clackers/report/format.hpp"

namespace clackers::report {
namespace {

bool is_control(char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }

// ASCII characters that LaTeX takes for its own, or prints as another one in its default encoding.
constexpr std::array<std::pair<char, std::string_view>, 14> own{{{'\\', "\\textbackslash{}"},
                                                                 {'{', "\\{"},
                                                                 {'}', "\\}"},
                                                                 {'$', "\\$"},
                                                                 {'&', "\\&"},
                                                                 {'#', "\\#"},
                                                                 {'_', "\\_"},
                                                                 {'%', "\\%"},
                                                                 {'~', "\\textasciitilde{}"},
                                                                 {'^', "\\textasciicircum{}"},
                                                                 {'<', "\\textless{}"},
                                                                 {'>', "\\textgreater{}"},
                                                                 {'|', "\\textbar{}"},
                                                                 {'`', "\\textasciigrave{}"}}};

// Characters beyond ASCII that LaTeX knows in formulas only.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> formulas{
    {{"−", "$-$"}, {"±", "$\\pm$"}, {"≤", "$\\le$"}, {"≥", "$\\ge$"}}};

void replace_all(std::string& text, std::string_view old, std::string_view by) {
  for (auto at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
    text.replace(at, old.size(), by);
}

}  // namespace

std::string tex_text(std::string_view text) {
  std::string out;
  bool quoted = false;
  char before = ' ';
  for (const char c : valid_utf8(text)) {
    const auto found = std::ranges::find(own, c, &std::pair<char, std::string_view>::first);
    if (found != own.end()) {
      out += found->second;
    } else if (c == '"') {
      out += quoted ? "''" : "``";
      quoted = !quoted;
    } else {
      // Two hyphens or two apostrophes would be drawn as one sign.
      if (c == before && (c == '-' || c == '\'')) out += "{}";
      out += is_control(c) ? ' ' : c;
    }
    before = c;
  }
  for (const auto& [sign, formula] : formulas) replace_all(out, sign, formula);
  return out;
}

std::string tex_comment(std::string_view text) {
  auto out = valid_utf8(text);
  std::ranges::replace_if(out, is_control, ' ');
  return out;
}

std::string tex_number(double value) {
  if (!std::isfinite(value)) return tex_scientific(value);
  const auto text = short_number(value, 3);
  return text.find('e') == std::string::npos ? "$" + text + "$" : tex_scientific(value);
}

std::string tex_scientific(double value, int decimals) {
  if (std::isnan(value)) return "--";
  if (std::isinf(value)) return value > 0.0 ? "$\\infty$" : "$-\\infty$";
  if (value == 0.0) return "$0$";
  const auto text = fmt::format("{:.{}e}", value, decimals);
  const auto e = text.find('e');
  return fmt::format("${}\\cdot 10^{{{}}}$", text.substr(0, e), std::stoi(text.substr(e + 1)));
}

}  // namespace clackers::report
