#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace clackers::report {

/// How the curve of one method looks in every figure and table of a page. Colour, dash and marker
/// differ together, so that a curve is known without colour; the first 24 looks are all different.
struct Look {
  std::string color;         ///< a variable of page.css, which knows light, dark and paper
  std::string_view shape;    ///< as Vega calls it
  std::vector<double> dash;  ///< lengths of strokes and gaps
};
Look look(std::size_t index);

/// A short stroke with its marker, as inline svg, for tables and legends. Decoration only: it
/// stands beside the name.
std::string key_svg(const Look& look);

}  // namespace clackers::report
