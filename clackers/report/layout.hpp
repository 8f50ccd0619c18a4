#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clackers/report/write.hpp"

namespace clackers::report {

/// How a text looks on a terminal that has colours.
enum class Paint { plain, bold, dim, green, red, yellow, blue };

/// `text` between the escape sequences of its paint; unchanged without style.color.
std::string painted(std::string_view text, Paint paint, const Style& style);

/// A column of a table of characters.
struct TextColumn {
  std::string header;       ///< wrapped into the column; its last line stands lowest
  bool right = false;       ///< aligned to the right, as numbers are
  std::size_t natural = 0;  ///< width of its widest cell
  std::size_t least = 0;    ///< the width below which it must not be wrapped
  std::size_t width = 0;    ///< chosen by fit
};

struct TextCell {
  std::string text;
  Paint paint = Paint::plain;
};

/// Chooses the widths so that columns and the `gap` between them take at most `total` characters:
/// each its natural width, or the widest ones narrowed, no further than their least. Returns false,
/// leaving the widths at the least, where that is not enough.
bool fit(std::span<TextColumn> columns, std::size_t gap, std::size_t total);

/// The headers and a rule below them.
void print_header(std::span<const TextColumn> columns, std::size_t gap, std::ostream& out,
                  const Style& style);

/// One row, over as many lines as its longest cell needs. No line ends in a space.
void print_row(std::span<const TextColumn> columns, std::span<const TextCell> cells,
               std::size_t gap, std::ostream& out, const Style& style);

}  // namespace clackers::report
