#include "clackers/report/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <ostream>

#include "clackers/report/format.hpp"

namespace clackers::report {
namespace {

std::size_t total_width(std::span<const TextColumn> columns, std::size_t gap) {
  if (columns.empty()) return 0;
  return std::accumulate(
      columns.begin(), columns.end(), gap * (columns.size() - 1),
      [](std::size_t sum, const TextColumn& column) { return sum + column.width; });
}

// Lines of cells next to each other. A line of the output is first put together and then printed
// without the spaces that its last cells would leave behind it.
void print_lines(std::span<const TextColumn> columns,
                 const std::vector<std::vector<std::string>>& cells, std::span<const Paint> paints,
                 bool lowest, std::size_t gap, std::ostream& out, const Style& style) {
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
        line += pending + painted(text, paints[c], style);
        pending.clear();
      }
      if (!column.right) pending.append(space, ' ');
    }
    out << line << '\n';
  }
}

}  // namespace

std::string painted(std::string_view text, Paint paint, const Style& style) {
  constexpr std::array<int, 7> codes{0, 1, 2, 32, 31, 33, 34};
  if (!style.color || paint == Paint::plain) return std::string(text);
  return fmt::format("\x1b[{}m{}\x1b[0m", codes[std::size_t(paint)], text);
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
  const std::vector<Paint> paints(columns.size(), Paint::bold);
  print_lines(columns, headers, paints, true, gap, out, style);
  std::string rule;
  for (std::size_t i = 0; i < total_width(columns, gap); ++i) rule += "─";
  out << painted(rule, Paint::dim, style) << '\n';
}

void print_row(std::span<const TextColumn> columns, std::span<const TextCell> cells,
               std::size_t gap, std::ostream& out, const Style& style) {
  std::vector<std::vector<std::string>> lines;
  std::vector<Paint> paints;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    lines.push_back(wrap(cells[c].text, columns[c].width));
    paints.push_back(cells[c].paint);
  }
  print_lines(columns, lines, paints, false, gap, out, style);
}

}  // namespace clackers::report
