#include "bindings/python/bind.hpp"

#include <pybind11/numpy.h>

#include <stdexcept>

namespace clackers::python {

input::NumberColumns columns_of(const std::string& name, const py::list& columns) {
  using Numbers = py::array_t<double>;
  input::NumberColumns table;
  table.name = name;
  for (const auto column : columns) {
    const auto [title, values] = column.cast<std::pair<std::string, py::object>>();
    if (!py::isinstance<Numbers>(values))
      throw std::invalid_argument("a column is no array of float64");
    const auto array = py::reinterpret_borrow<Numbers>(values);
    if (array.ndim() != 1 || array.strides(0) % py::ssize_t(sizeof(double)) != 0)
      throw std::invalid_argument("a column is no aligned array of one dimension");
    const auto rows = std::size_t(array.size());
    if (!table.columns.empty() && rows != table.rows)
      throw std::invalid_argument("columns have different lengths");
    table.rows = rows;
    table.columns.push_back({title, array.data(), array.strides(0) / py::ssize_t(sizeof(double))});
  }
  return table;
}

input::Source source_of(py::handle source) {
  if (py::isinstance<py::bytes>(source)) return source.cast<std::string>();
  const auto [name, columns] = source.cast<std::pair<std::string, py::list>>();
  return columns_of(name, columns);
}

}  // namespace clackers::python
