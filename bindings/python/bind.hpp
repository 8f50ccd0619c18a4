#pragma once

#include <pybind11/pybind11.h>

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

}  // namespace clackers::python
