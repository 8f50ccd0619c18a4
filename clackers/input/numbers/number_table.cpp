#include "clackers/input/numbers/number_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "clackers/base/error.hpp"

namespace clackers::input {
namespace {

// Of the shortest decimal text that reads back to x; 0 for zero.
int shortest_digits(double x) {
  if (x == 0.0) return 0;
  std::array<char, 32> text;
  const auto* end =
      std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::scientific).ptr;
  const auto* mantissa_end = std::find(text.data(), const_cast<char*>(end), 'e');
  return static_cast<int>(std::count_if(static_cast<const char*>(text.data()), mantissa_end,
                                        [](char c) { return c >= '0' && c <= '9'; }));
}

}  // namespace

NumberTable::NumberTable(const NumberColumns& columns, const std::vector<std::string>& names,
                         TableKind kind, const std::atomic<bool>* interrupt)
    : Table(columns.name),
      block_(&columns),
      rows_(columns.rows),
      next_block_(columns.rows),
      interrupt_(interrupt) {
  name_columns(names, kind);
}

NumberTable::NumberTable(NpyFile file, const std::vector<std::string>& names, TableKind kind,
                         const std::atomic<bool>* interrupt)
    : Table(file.name()),
      file_(std::move(file)),
      block_(&file_->block()),
      rows_(file_->rows()),
      interrupt_(interrupt) {
  name_columns(names, kind);
}

void NumberTable::name_columns(const std::vector<std::string>& given, TableKind kind) {
  const auto& columns = block_->columns;
  const bool events = kind == TableKind::events;
  const bool unnamed =
      std::ranges::all_of(columns, [](const NumberColumn& c) { return c.name.empty(); });
  std::vector<std::string> names;
  if (!given.empty()) {
    for (const auto& name : given) names.push_back(plain_name(name));
  } else if (!unnamed) {
    for (const auto& column : columns) names.push_back(plain_name(column.name));
  } else if (events && columns.size() == 1) {
    names.emplace_back("t");
  } else {
    throw InputError(
        fmt::format("{}: {} columns of numbers have no names; {}.", name(), columns.size(),
                    events ? "save a structured array with a field t, or only times"
                           : "save a structured array whose fields have the names, or give them "
                             "with --columns, for example --columns t,u1,v1 (_ skips one)"),
        "no-column");
  }
  if (names.size() != columns.size())
    throw InputError(
        fmt::format("{} has {} columns; allowed: {}, one for each name.{}", name(), columns.size(),
                    names.size(),
                    names.size() == rows_ ? " Rows are times: save the transposed array." : ""),
        "ragged-row");
  if (rows_ == 0 && !events)
    throw InputError(name() + " has no rows; allowed: rows of numbers.", "too-short");
  digits_.resize(names.size());
  set_names(std::move(names));
}

bool NumberTable::next() {
  constexpr std::size_t rows_a_look = 4096;
  if (next_row_ % rows_a_look == 0 && interrupt_ != nullptr && *interrupt_)
    throw Error("interrupted", "interrupted");
  if (next_row_ == rows_) return false;
  if (next_row_ == next_block_) {
    file_->next_block();
    next_block_ += block_->rows;
  }
  ++next_row_;
  return true;
}

double NumberTable::value(std::size_t column) const {
  const auto& numbers = block_->columns[column];
  if (numbers.first == nullptr)
    throw InputError(fmt::format("{}: column {} holds no real numbers; allowed: {}.", name(),
                                 names()[column], NpyFile::allowed_numbers),
                     "not-a-number");
  const auto row = next_row_ - 1 - (next_block_ - block_->rows);
  return numbers.first[std::ptrdiff_t(row) * numbers.stride];
}

void NumberTable::read_number(std::size_t column, Number& number) {
  number.value = value(column);
  if (!std::isfinite(number.value)) refuse_not_finite(column, fmt::format("{}", number.value));
  auto& digits = digits_[column];
  if (digits < std::numeric_limits<double>::max_digits10)
    digits = std::max(digits, shortest_digits(number.value));
  number.digits = digits;
}

RowSide NumberTable::side(std::size_t column) const {
  const double side = value(column);
  if (side == 0.0) return RowSide::none;
  if (std::abs(side) != 1.0)
    refuse(place(), "side", side, "-1 (before the jump), 1 (after it) or 0");
  return side < 0.0 ? RowSide::before : RowSide::after;
}

std::string NumberTable::place() const {
  return fmt::format("{} row {} (from 0)", name(), next_row_ - 1);
}

std::size_t NumberTable::expected_rows() const {
  return file_ && !file_->size_is_known() ? 0 : rows_;
}

double NumberTable::share() const { return double(next_row_) / double(rows_); }

}  // namespace clackers::input
