#include "clackers/report/html/plot_style.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace clackers::report {
namespace {

constexpr std::size_t colors = 8;

// Vega's markers and the same as paths around the origin.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> shapes{
    {{"circle", "M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0Z"},
     {"square", "M-3.6,-3.6H3.6V3.6H-3.6Z"},
     {"triangle-up", "M0,-4.4L4.6,3.6H-4.6Z"},
     {"diamond", "M0,-5L4.4,0L0,5L-4.4,0Z"},
     {"cross", "M-1.6,-4.6H1.6V-1.6H4.6V1.6H1.6V4.6H-1.6V1.6H-4.6V-1.6H-1.6Z"},
     {"triangle-down", "M0,4.4L4.6,-3.6H-4.6Z"},
     {"triangle-right", "M4.4,0L-3.6,4.6V-4.6Z"}}};

const std::array<std::vector<double>, 6>& dashes() {
  static const std::array<std::vector<double>, 6> table{
      {{1, 0}, {7, 3}, {2, 2}, {8, 3, 2, 3}, {4, 2}, {11, 3}}};
  return table;
}

std::string color(std::size_t index) { return fmt::format("var(--m{})", index % colors + 1); }

}  // namespace

MassStyle mass_style(std::size_t mass) {
  static const std::array<std::vector<double>, 4> dashes{{{1, 0}, {5, 2}, {2, 2}, {8, 3, 2, 3}}};
  return {color(mass), dashes[(mass + mass / colors) % dashes.size()]};
}

PlotStyle plot_style(std::size_t index) {
  // Every round of colours shifts dashes and markers, by amounts that do not come round at once.
  const auto round = index / colors;
  return {color(index), shapes[(index + round) % shapes.size()].first,
          dashes()[(index + 2 * round) % dashes().size()]};
}

std::string key_svg(const PlotStyle& style) {
  std::string_view path;
  for (const auto& [name, shape] : shapes)
    if (name == style.shape) path = shape;
  return line_svg(style.color, fmt::format("{}", fmt::join(style.dash, " ")),
                  fmt::format("<path d=\"{}\" fill=\"currentColor\"/>", path));
}

std::string key_svg(const MassStyle& style) {
  return line_svg(style.color, fmt::format("{}", fmt::join(style.dash, " ")));
}

std::string line_svg(std::string_view color, std::string_view dash, std::string_view marker) {
  return fmt::format(
      "<svg class=\"key\" width=\"34\" height=\"12\" viewBox=\"-17 -6 34 12\" aria-hidden=\"true\" "
      "focusable=\"false\" style=\"color:{}\"><path d=\"M-17,0H17\" stroke=\"currentColor\" "
      "stroke-width=\"2\" stroke-dasharray=\"{}\" fill=\"none\"/>{}</svg>",
      color, dash, marker);
}

}  // namespace clackers::report
