#pragma once

#include <pybind11/pybind11.h>

#include "clackers/record/sheet.hpp"

namespace clackers::python {

namespace py = pybind11;

/// All rows of a source as clackers.Table takes them: (schema, title, columns, arrays), a column being
/// (name, unit, meaning). Real numbers become float64 (an empty cell NaN), whole ones int64, sides int8
/// (-1, 0, 1), all else text (an empty cell None). Without the GIL, and Ctrl-C ends it.
py::tuple read_rows(record::RowSource& rows);

}  // namespace clackers::python
