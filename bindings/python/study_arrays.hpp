#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "clackers/input/source.hpp"

namespace clackers::python {

namespace py = pybind11;

/// Arrays of one dimension as columns of a table: a list of (name, float64 array) of equal lengths, any
/// strides. The arrays must outlive the result. Throws std::invalid_argument for anything else, since
/// clackers._history makes these lists.
input::NumberColumns columns_of(const std::string& name, const py::list& columns);

/// A path, or such a list under a name: a str, or (name, list).
input::Source source_of(py::handle source);

}  // namespace clackers::python
