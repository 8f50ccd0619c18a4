#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <string>

#include "clackers/input/source.hpp"
#include "clackers/record/sheet.hpp"

/// The extension module clackers._core. Its functions are private; the package in clackers/ documents
/// what users call.
namespace clackers::python {

namespace py = pybind11;

// The parts of the module, one a source file.
void bind_errors(py::module_& core);
void bind_problem(py::module_& core);
void bind_case(py::module_& core);
void bind_response(py::module_& core);
void bind_impacts(py::module_& core);
void bind_quantities(py::module_& core);
void bind_tables(py::module_& core);
void bind_inputs(py::module_& core);
void bind_record(py::module_& core);
void bind_study(py::module_& core);

/// Looks for Ctrl-C during long work that has released the GIL: every 50 ms it takes the GIL for a
/// moment. Throws what the signal's handler raised, KeyboardInterrupt by default.
class Interrupts {
 public:
  void check() {
    const auto now = Clock::now();
    if (now - last_ < std::chrono::milliseconds(50)) return;
    last_ = now;
    const pybind11::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

/// All rows of a source as clackers.Table takes them: (schema, title, columns, arrays), a column being
/// (name, unit, meaning). Real numbers become float64 (an empty cell NaN), whole ones int64, sides int8
/// (-1, 0, 1), all else text (an empty cell None). Without the GIL, and Ctrl-C ends it.
py::tuple read_rows(record::RowSource& rows);

/// Arrays of one dimension as columns of a table: a list of (name, float64 array) of equal lengths, any
/// strides. The arrays must outlive the result. Throws std::invalid_argument for anything else, since
/// clackers._history makes these lists.
input::NumberColumns columns_of(const std::string& name, const py::list& columns);

/// A path, or such a list under a name: bytes, or (name, list).
input::Source source_of(py::handle source);

}  // namespace clackers::python
