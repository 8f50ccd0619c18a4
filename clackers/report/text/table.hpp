#pragma once

#include <cstddef>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/report/write.hpp"

// Tables of characters. Control characters of the texts are printed as "\xNN".
namespace clackers::report {

/// How a text looks on a terminal that has colours.
enum class TextColor { plain, bold, dim, green, red, yellow, blue };

/// `text` between the escape sequences of its colour; unchanged without style.color.
std::string colored(std::string_view text, TextColor color, const Style& style);

/// A text in lines of at most style.width characters.
void print_wrapped(std::string_view text, std::ostream& out, const Style& style,
                   TextColor color = TextColor::plain);

/// A column of a table.
struct TextColumn {
  std::string header;       ///< wrapped into the column; its last line stands lowest
  bool right = false;       ///< aligned to the right, as numbers are
  std::size_t natural = 0;  ///< width of its widest cell
  std::size_t least = 0;    ///< the width below which it must not be wrapped
  std::size_t width = 0;    ///< chosen by fit
};

struct TextCell {
  std::string text;
  TextColor color = TextColor::plain;
};

/// A line of its own above a row of a table.
struct TableHead {
  std::size_t row;
  std::string text;
};

/// A whole table of at most style.width characters a line. The columns' widths are measured: the
/// first column and text to the right of it may be wrapped, numbers stay whole unless the terminal is
/// very narrow.
void print_table(std::vector<TextColumn> columns, const std::vector<std::vector<TextCell>>& rows,
                 std::ostream& out, const Style& style, std::span<const TableHead> heads = {});

// The parts of print_table, for rows that come one by one.

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
