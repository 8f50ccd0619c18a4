#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>

#include "bindings/python/arguments.hpp"
#include "bindings/python/bind.hpp"
#include "bindings/python/problem.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/model/problem_file.hpp"
#include "clackers/tables/respond.hpp"

namespace clackers::python {
namespace {

using cases::Case;

std::shared_ptr<Case> make(py::handle name, const py::dict& parameters, py::handle threshold) {
  const auto text =
      name.is_none() ? std::string(cases::default_case()) : read_text("case", "name", name);
  const double share =
      threshold.is_none() ? cases::default_threshold : read_number(text, "threshold", threshold);
  return std::make_shared<Case>(cases::make(text, read_settings(text, parameters), share));
}

py::dict values(const std::vector<Quantity>& constants) {
  py::dict all;
  for (const auto& constant : constants) all[py::str(constant.name)] = constant.value;
  return all;
}

py::dict parameters(const Case& test_case) {
  py::dict all;
  for (const auto& [name, value] : test_case.values)
    all[py::str(name)] = value.is_word() ? py::object(py::str(value.text())) : py::float_(value);
  return all;
}

// (r*, margin)
py::tuple admissibility(py::handle X, py::handle r) {
  const auto found = cases::admissibility(read_number("admissibility", "X", X),
                                          read_number("admissibility", "r", r));
  return py::make_tuple(found.r_star, found.margin);
}

}  // namespace

void bind_case(py::module_& core) {
  py::class_<Case, std::shared_ptr<Case>>(core, "Case")
      .def(py::init(&make), py::arg("name"), py::arg("parameters"), py::arg("threshold"))
      .def_property_readonly("name", [](const Case& c) { return c.entry->name; })
      .def_property_readonly("summary", [](const Case& c) { return c.entry->summary; })
      .def_property_readonly("equations", [](const Case& c) { return c.entry->equations; })
      .def_property_readonly("parameters", &parameters)
      .def_property_readonly("constants", [](const Case& c) { return values(c.constants); })
      .def_property_readonly("indicators", [](const Case& c) { return values(c.indicators); })
      .def_property_readonly("dof", [](const Case& c) { return c.motion->dof(); })
      .def_property_readonly("end", [](const Case& c) { return c.motion->end(); })
      .def_property_readonly("mesh",
                             [](const Case& c) {
                               return c.mesh ? std::optional(model::mesh_json(*c.mesh))
                                             : std::nullopt;
                             })
      .def_property_readonly("accumulates",
                             [](const Case& c) { return tables::accumulates(*c.motion); })
      .def_property_readonly("problem", [](const std::shared_ptr<Case>& c) {
        return Problem({c, &c->problem});  // keeps the case alive
      });
  core.def("admissibility", &admissibility, py::arg("X"), py::arg("r"));
}

}  // namespace clackers::python
