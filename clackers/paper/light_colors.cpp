#include <stdexcept>

#include "clackers/paper/specification.hpp"
#include "clackers/report/assets.hpp"

namespace clackers::paper {
namespace {

std::string light_color(const std::string& name) {
  const std::string_view sheet = report::assets::page_css;
  const auto declaration = name + ": light-dark(";
  const auto at = sheet.find(declaration);
  if (at == std::string_view::npos) throw std::logic_error("the style sheet has no " + name);
  const auto from = at + declaration.size();
  return std::string(sheet.substr(from, sheet.find(',', from) - from));
}

}  // namespace

std::string with_light_colors(const std::string& text) {
  constexpr std::string_view opening = "var(";
  std::string out;
  std::size_t done = 0;
  for (auto at = text.find(opening); at != std::string::npos; at = text.find(opening, done)) {
    const auto end = text.find(')', at);
    if (end == std::string::npos) break;
    out += text.substr(done, at - done);
    out += light_color(text.substr(at + opening.size(), end - at - opening.size()));
    done = end + 1;
  }
  return out + text.substr(done);
}

}  // namespace clackers::paper
