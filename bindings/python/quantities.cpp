#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "bindings/python/arguments.hpp"
#include "bindings/python/bind.hpp"
#include "clackers/tables/respond.hpp"

namespace clackers::python {
namespace {

using cases::Case;

tables::TimeGrid read_grid(std::string_view who, py::handle t) {
  const auto times = read_vector(who, "t", t);
  const auto values = values_of(times);
  tables::TimeGrid grid;
  grid.times.assign(values.begin(), values.end());
  return grid;
}

py::tuple energies(const Case& test_case, py::handle t) {
  return read_rows(*tables::energies(test_case, read_grid("energies", t)));
}

py::tuple points(const Case& test_case, py::handle t, py::handle at) {
  const auto list = read_vector("points", "at", at);
  const auto places = values_of(list);
  const auto grid = t.is_none() ? tables::contact_grid(test_case) : read_grid("points", t);
  return read_rows(*tables::points(test_case, grid, {places.begin(), places.end()}));
}

py::tuple forces(const Case& test_case, py::handle t) {
  return read_rows(*tables::forces(test_case, read_grid("forces", t)));
}

py::tuple digits(const Case& test_case, py::handle digits, py::handle t) {
  const auto count = read_whole("digits", "digits", digits);
  if (t.is_none()) return read_rows(*tables::impacts(test_case, count));
  return read_rows(*tables::respond(test_case, read_grid("digits", t), count));
}

py::tuple sensitivity(const Case& test_case, py::handle name, py::handle t) {
  const auto text = read_text("sensitivity", "name", name);
  return read_rows(*tables::sensitivity(test_case, read_grid("sensitivity", t), text));
}

py::tuple spectrum(const Case& test_case, py::handle n, py::handle highest) {
  const auto count = read_whole("spectrum", "n", n);
  return read_rows(
      *tables::spectrum(test_case, count, read_number("spectrum", "highest", highest)));
}

}  // namespace

void bind_quantities(py::module_& core) {
  core.def("energies", &energies, py::arg("case"), py::arg("t"));
  core.def("points", &points, py::arg("case"), py::arg("t"), py::arg("at"));
  core.def("forces", &forces, py::arg("case"), py::arg("t"));
  core.def("digits", &digits, py::arg("case"), py::arg("digits"), py::arg("t"));
  core.def("sensitivity", &sensitivity, py::arg("case"), py::arg("name"), py::arg("t"));
  core.def("spectrum", &spectrum, py::arg("case"), py::arg("n"), py::arg("highest"));
}

}  // namespace clackers::python
