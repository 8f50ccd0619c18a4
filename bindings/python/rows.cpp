#include "bindings/python/bind.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bindings/python/arguments.hpp"

namespace clackers::python {
namespace {

using record::Cell;
using record::ColumnKind;

py::list columns_of_source(const record::RowSource& rows) {
  py::list columns;
  for (const auto& column : rows.columns())
    columns.append(py::make_tuple(column.name, column.unit, column.meaning));
  return columns;
}

py::tuple table(const record::RowSource& rows, const py::list& arrays) {
  return py::make_tuple(rows.schema(), rows.title(), columns_of_source(rows), arrays);
}

// Numbers come in blocks, row by row; each column gets an array of its own.
py::list read_numbers(record::NumberRows& rows) {
  const auto width = rows.columns().size();
  long long count = 0;
  {
    const py::gil_scoped_release without_gil;
    count = rows.count();
  }
  std::vector<Doubles> columns;
  std::vector<double*> to;
  for (std::size_t c = 0; c < width; ++c) {
    columns.emplace_back(py::ssize_t(count));
    to.push_back(columns.back().mutable_data());
  }
  {
    const py::gil_scoped_release without_gil;
    std::vector<double> block;
    while (rows.next_block(block))
      for (std::size_t at = 0; at < block.size();)
        for (auto*& place : to) *place++ = block[at++];
  }
  py::list arrays;
  for (std::size_t c = 0; c < width; ++c) {
    const auto kind = rows.columns()[c].kind;
    const char* type = kind == ColumnKind::whole ? "int64" : "int8";
    arrays.append(kind == ColumnKind::real ? py::object(columns[c])
                                           : columns[c].attr("astype")(type));
  }
  return arrays;
}

py::object object_of(const Cell& cell) {
  if (const auto* real = std::get_if<double>(&cell)) return py::float_(*real);
  if (const auto* whole = std::get_if<long long>(&cell)) return py::int_(*whole);
  if (const auto* text = std::get_if<std::string>(&cell)) return py::str(*text);
  return py::none();
}

// Whether every cell is one of these kinds, and one at least not empty.
template <class... Kinds>
bool holds_only(const std::vector<Cell>& cells) {
  const auto is_one = [](const Cell& cell) { return (std::holds_alternative<Kinds>(cell) || ...); };
  const auto is_empty = [](const Cell& cell) { return cell.index() == 0; };
  return std::ranges::all_of(cells, is_one) && !std::ranges::all_of(cells, is_empty);
}

py::object array_of(const std::vector<Cell>& cells, ColumnKind kind) {
  py::list objects;
  const auto numpy_array = py::module_::import("numpy").attr("array");
  if (kind == ColumnKind::side) {
    for (const auto& cell : cells) {
      const auto* side = std::get_if<std::string>(&cell);
      objects.append(side == nullptr ? 0 : *side == "+" ? 1 : -1);
    }
    return numpy_array(objects, py::arg("dtype") = "int8");
  }
  const bool numbers =
      kind == ColumnKind::real || holds_only<double, long long, std::monostate>(cells);
  for (const auto& cell : cells)
    objects.append(numbers && cell.index() == 0
                       ? py::object(py::float_(std::numeric_limits<double>::quiet_NaN()))
                       : object_of(cell));
  const bool whole = kind != ColumnKind::real && holds_only<long long>(cells);
  const char* type = whole ? "int64" : numbers ? "float64" : "object";
  return numpy_array(objects, py::arg("dtype") = type);
}

py::list read_cells(record::RowSource& rows) {
  std::vector<std::vector<Cell>> columns(rows.columns().size());
  std::vector<Cell> row;
  while (rows.next(row))
    for (std::size_t c = 0; c < row.size(); ++c) columns[c].push_back(row[c]);
  py::list arrays;
  for (std::size_t c = 0; c < columns.size(); ++c)
    arrays.append(array_of(columns[c], rows.columns()[c].kind));
  return arrays;
}

}  // namespace

py::tuple read_rows(record::RowSource& rows) {
  Interrupts interrupts;
  rows.progress = [&](double) { interrupts.check(); };
  auto* const numbers = rows.numbers();
  const auto arrays = numbers == nullptr ? read_cells(rows) : read_numbers(*numbers);
  rows.progress = nullptr;
  return table(rows, arrays);
}

}  // namespace clackers::python
