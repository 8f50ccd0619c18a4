#include "clackers/record/sheet.hpp"

#include <cmath>

namespace clackers::record {
namespace {

Cell cell(double value, ColumnKind kind) {
  if (kind == ColumnKind::whole) return static_cast<long long>(value);
  if (kind != ColumnKind::side) return value;
  return value == 0.0 ? Cell{} : Cell{std::string(value < 0.0 ? "-" : "+")};
}

}  // namespace

double number_in(const Cell& cell) {
  if (const auto* real = std::get_if<double>(&cell)) return *real;
  if (const auto* whole = std::get_if<long long>(&cell)) return double(*whole);
  return std::nan("");
}

Cell cell_of(double number) { return std::isnan(number) ? Cell() : Cell(number); }

void drop_columns(Sheet& sheet, const std::function<bool(std::size_t)>& goes) {
  for (auto j = sheet.columns.size(); j-- > 0;) {
    if (!goes(j)) continue;
    sheet.columns.erase(sheet.columns.begin() + std::ptrdiff_t(j));
    for (auto& row : sheet.rows) row.erase(row.begin() + std::ptrdiff_t(j));
  }
}

bool NumberRows::next(std::vector<Cell>& row) {
  if (read_ == block_.size()) {
    read_ = 0;
    if (!next_block(block_)) return false;
  }
  row.clear();
  for (const auto& column : columns()) row.push_back(cell(block_[read_++], column.kind));
  return true;
}

}  // namespace clackers::record
