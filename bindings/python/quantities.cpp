#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "bindings/python/arguments.hpp"
#include "bindings/python/bind.hpp"
#include "bindings/python/rows.hpp"
#include "clackers/study/respond.hpp"

namespace clackers::python {
namespace {

using cases::Case;

study::TimeGrid read_grid(std::string_view who, py::handle t) {
  const auto times = read_vector(who, "t", t);
  const auto values = values_of(times);
  study::TimeGrid grid;
  grid.times.assign(values.begin(), values.end());
  return grid;
}

py::tuple energies(const Case& which, py::handle t) {
  return read_rows(*study::energies(which, read_grid("energies", t)));
}

py::tuple sensitivity(const Case& which, const std::string& name, py::handle t) {
  return read_rows(*study::sensitivity(which, read_grid("sensitivity", t), name));
}

py::tuple spectrum(const Case& which, long long n, double highest) {
  return read_rows(*study::spectrum(which, n, highest));
}

}  // namespace

void bind_quantities(py::module_& core) {
  core.def("energies", &energies, py::arg("case"), py::arg("t"));
  core.def("sensitivity", &sensitivity, py::arg("case"), py::arg("name"), py::arg("t"));
  core.def("spectrum", &spectrum, py::arg("case"), py::arg("n"), py::arg("highest"));
}

}  // namespace clackers::python
