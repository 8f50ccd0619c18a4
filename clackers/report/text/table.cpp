#include "clackers/report/text/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <ostream>

#include "clackers/base/text.hpp"
#include "clackers/report/format.hpp"

namespace clackers::report {
namespace {

std::size_t total_width(std::span<const TextColumn> columns, std::size_t gap) {
  if (columns.empty()) return 0;
  return std::accumulate(
      columns.begin(), columns.end(), gap * (columns.size() - 1),
      [](std::size_t sum, const TextColumn& column) { return sum + column.width; });
}

std::size_t widest_word(std::string_view text) {
  std::size_t widest = 0;
  for (std::size_t from = 0; from < text.size();) {
    const auto to = std::min(text.find_first_of(" \n", from), text.size());
    widest = std::max(widest, display_width(text.substr(from, to - from)));
    from = to + 1;
  }
  return widest;
}

// Lines of cells next to each other. A line of the output is first put together and then printed
// without the spaces that its last cells would leave behind it.
void print_lines(std::span<const TextColumn> columns,
                 const std::vector<std::vector<std::string>>& cells,
                 std::span<const TextColor> colors, bool lowest, std::size_t gap, std::ostream& out,
                 const Style& style) {
  std::size_t height = 1;
  for (const auto& lines : cells) height = std::max(height, lines.size());
  for (std::size_t i = 0; i < height; ++i) {
    std::string line, pending;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto& lines = cells[c];
      const auto skipped = lowest ? height - lines.size() : 0;
      const std::string text = i < skipped || i - skipped >= lines.size() ? "" : lines[i - skipped];
      const auto& column = columns[c];
      const auto used = display_width(text);
      const auto space = column.width > used ? column.width - used : 0;
      if (c > 0) pending.append(gap, ' ');
      if (column.right) pending.append(space, ' ');
      if (!text.empty()) {
        line += pending + colored(printable(text), colors[c], style);
        pending.clear();
      }
      if (!column.right) pending.append(space, ' ');
    }
    out << line << '\n';
  }
}

}  // namespace

std::string colored(std::string_view text, TextColor color, const Style& style) {
  constexpr std::array<int, 7> codes{0, 1, 2, 32, 31, 33, 34};
  if (!style.color || color == TextColor::plain) return std::string(text);
  return fmt::format("\x1b[{}m{}\x1b[0m", codes[std::size_t(color)], text);
}

void print_wrapped(std::string_view text, std::ostream& out, const Style& style, TextColor color) {
  const auto width = std::size_t(std::max(style.width, 20));
  for (const auto& line : wrap(printable(text), width)) out << colored(line, color, style) << '\n';
}

void print_table(std::vector<TextColumn> columns, const std::vector<std::vector<TextCell>>& rows,
                 std::ostream& out, const Style& style, std::span<const TableHead> heads) {
  constexpr std::size_t least_text = 8;
  std::size_t gap = 2;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    auto& column = columns[c];
    const auto header = widest_word(column.header);
    column.natural = header;
    for (const auto& row : rows)
      column.natural = std::max(column.natural, display_width(printable(row[c].text)));
    const bool may_wrap = !column.right && (c == 0 || column.natural > 3 * least_text);
    column.least = may_wrap ? std::max(header, least_text) : column.natural;
  }
  const auto width = std::size_t(std::max(style.width, 1));
  // Rather than a wrapped name a narrower gap.
  const auto is_whole = [](const TextColumn& column) { return column.width == column.natural; };
  if (!fit(columns, gap, width) || !std::ranges::all_of(columns, is_whole)) gap = 1;
  if (!fit(columns, gap, width)) {
    for (auto& column : columns) column.least = 3;
    fit(columns, gap, width);
  }
  print_header(columns, gap, out, style);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!heads.empty() && heads.front().row == i) {
      if (i > 0) out << '\n';
      print_wrapped(heads.front().text, out, style, TextColor::bold);
      heads = heads.subspan(1);
    }
    print_row(columns, rows[i], gap, out, style);
  }
}

bool fit(std::span<TextColumn> columns, std::size_t gap, std::size_t total) {
  for (auto& column : columns) {
    column.least = std::min(column.least, column.natural);
    column.width = column.natural;
  }
  // The widest of the columns that can still give way loses a character, until all fits.
  while (total_width(columns, gap) > total) {
    TextColumn* widest = nullptr;
    for (auto& column : columns)
      if (column.width > column.least && (widest == nullptr || column.width > widest->width))
        widest = &column;
    if (widest == nullptr) return false;
    --widest->width;
  }
  return true;
}

void print_header(std::span<const TextColumn> columns, std::size_t gap, std::ostream& out,
                  const Style& style) {
  std::vector<std::vector<std::string>> headers;
  for (const auto& column : columns) headers.push_back(wrap(column.header, column.width));
  const std::vector<TextColor> colors(columns.size(), TextColor::bold);
  print_lines(columns, headers, colors, true, gap, out, style);
  std::string rule;
  for (std::size_t i = 0; i < total_width(columns, gap); ++i) rule += "─";
  out << colored(rule, TextColor::dim, style) << '\n';
}

void print_row(std::span<const TextColumn> columns, std::span<const TextCell> cells,
               std::size_t gap, std::ostream& out, const Style& style) {
  std::vector<std::vector<std::string>> lines;
  std::vector<TextColor> colors;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    lines.push_back(wrap(cells[c].text, columns[c].width));
    colors.push_back(cells[c].color);
  }
  print_lines(columns, lines, colors, false, gap, out, style);
}

}  // namespace clackers::report
