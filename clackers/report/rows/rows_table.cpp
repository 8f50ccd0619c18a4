#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "clackers/base/text.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/text/table.hpp"
#include "clackers/report/writers.hpp"

namespace clackers::report {
namespace {

using CellRow = std::vector<record::Cell>;

constexpr std::size_t rows_measured = 1000;
constexpr int most_digits = 6, fewest_digits = 3;
// Rows that were not measured may hold any real number, for which seven characters are enough, and
// counters that have grown.
constexpr std::size_t any_number = 8;
// Text is wrapped to no less than this, so that a sentence stays readable.
constexpr std::size_t least_text = 12;

std::string text_of(const record::Cell& cell, int digits, std::size_t width) {
  if (const auto* real = std::get_if<double>(&cell))
    return short_number(*real + 0.0, digits, width);  // no -0
  if (const auto* whole = std::get_if<long long>(&cell)) return fmt::format("{}", *whole);
  if (const auto* text = std::get_if<std::string>(&cell))
    return rejoin(std::string_view(*text).substr(0, text->find_last_not_of(" \n") + 1));
  return {};
}

bool is_number(const record::Cell& cell) { return cell.index() == 1 || cell.index() == 2; }

std::size_t widest_line(std::string_view text) {
  std::size_t widest = 0;
  for (const auto& line : wrap(text, text.size() + 1))
    widest = std::max(widest, display_width(line));
  return widest;
}

std::size_t longest_word(std::string_view text) {
  std::size_t longest = 0;
  for (std::size_t from = 0; from < text.size();) {
    const auto to = std::min(text.find_first_of(" \n_", from), text.size());
    longest = std::max(longest, display_width(text.substr(from, to - from)) + 1);
    from = to + 1;
  }
  return longest;
}

// The columns as wide as the measured rows need them when numbers have `digits` digits.
std::vector<TextColumn> measure(const std::vector<record::Column>& columns,
                                const std::vector<CellRow>& rows, int digits) {
  std::vector<TextColumn> out;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    TextColumn column;
    bool numbers = false, texts = false;
    std::size_t content = 0;
    for (const auto& row : rows) {
      numbers = numbers || is_number(row[c]);
      texts = texts || std::holds_alternative<std::string>(row[c]);
      content = std::max(content, widest_line(text_of(row[c], digits, 32)));
    }
    const auto& name = columns[c].name;
    const auto unit = columns[c].unit.empty() ? "" : fmt::format("[{}]", columns[c].unit);
    column.header = unit.empty() ? name : name + '\n' + unit;
    column.right = numbers && !texts;
    const auto header = std::max(longest_word(name) - (name.empty() ? 0 : 1), display_width(unit));
    column.natural = std::max({content, header, std::size_t{1}});
    if (column.right && rows.size() == rows_measured)
      column.natural = std::max(column.natural, any_number);
    column.least =
        column.right ? column.natural : std::min(std::max(header, least_text), column.natural);
    out.push_back(std::move(column));
  }
  return out;
}

// The most digits that fit; first with two spaces between columns, then with one.
bool choose_layout(const std::vector<record::Column>& columns, const std::vector<CellRow>& rows,
                   std::size_t width, std::vector<TextColumn>& layout, int& digits,
                   std::size_t& gap) {
  for (digits = most_digits; digits >= fewest_digits; --digits)
    for (gap = 2; gap >= 1; --gap) {
      layout = measure(columns, rows, digits);
      if (fit(layout, gap, width)) return true;
    }
  return false;
}

void print_block(const std::vector<record::Column>& columns, const CellRow& row, std::size_t width,
                 std::ostream& out) {
  for (std::size_t c = 0; c < row.size(); ++c) {
    auto text = columns[c].name + ": " + text_of(row[c], most_digits, 32);
    if (!columns[c].unit.empty()) text += ' ' + columns[c].unit;
    text.erase(text.find_last_not_of(' ') + 1);
    for (const auto& line : wrap(text, width)) out << printable(line) << '\n';
  }
  out << '\n';
}

}  // namespace

void write_table(record::RowSource& rows, std::ostream& out, const Style& style) {
  const auto width = std::size_t(std::max(style.width, 1));
  if (!rows.title().empty())
    for (const auto& line : wrap(rows.title(), width))
      out << colored(line, TextColor::bold, style) << '\n';

  const auto& columns = rows.columns();
  if (columns.empty()) return;
  std::vector<CellRow> first;
  CellRow row;
  while (first.size() < rows_measured && rows.next(row)) first.push_back(row);
  if (first.empty() && !rows.title().empty()) return;  // names of columns above nothing say nothing

  std::vector<TextColumn> layout;
  int digits = most_digits;
  std::size_t gap = 2;
  const bool fits = choose_layout(columns, first, width, layout, digits, gap);
  const auto print = [&](const CellRow& cells) {
    if (!fits) return print_block(columns, cells, width, out);
    std::vector<TextCell> texts;
    for (std::size_t c = 0; c < cells.size(); ++c)
      texts.push_back({text_of(cells[c], digits, layout[c].width)});
    print_row(layout, texts, gap, out, style);
  };

  // A single column of text is a text; its title says what it is.
  if (fits && (layout.size() > 1 || layout[0].right)) print_header(layout, gap, out, style);
  for (const auto& cells : first) print(cells);
  if (first.size() == rows_measured)
    while (out && rows.next(row)) print(row);
}

}  // namespace clackers::report
