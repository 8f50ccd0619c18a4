#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace clackers::report {

/// How the curve of one method looks in every figure and table of a page. Colour, dash and marker
/// differ together, so that a curve is known without colour; the first 24 styles are all different.
struct PlotStyle {
  std::string color;         ///< a variable of page.css, which knows light, dark and paper
  std::string_view shape;    ///< as Vega calls it
  std::vector<double> dash;  ///< lengths of strokes and gaps
};
PlotStyle plot_style(std::size_t index);

/// How the displacement of a mass looks, by its colour and dash.
struct MassStyle {
  std::string color;         ///< a variable of page.css
  std::vector<double> dash;  ///< lengths of strokes and gaps
};
/// `mass` from 0; the first 32 styles are all different.
MassStyle mass_style(std::size_t mass);
/// A short stroke in that style, for legends.
std::string key_svg(const MassStyle& style);

/// A short stroke with its marker, as inline svg, for tables and legends. Decoration only: it
/// stands beside the name.
std::string key_svg(const PlotStyle& style);

/// A short stroke in a colour and with a dash, and what is drawn over it.
std::string line_svg(std::string_view color, std::string_view dash, std::string_view marker = {});

}  // namespace clackers::report
