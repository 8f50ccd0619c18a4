#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <stdexcept>

#include "bindings/python/arguments.hpp"
#include "bindings/python/bind.hpp"
#include "clackers/base/error.hpp"

// The readers of arguments and the refusal, for the files of the package.
namespace clackers::python {
namespace {

// Those that the package refuses with.
constexpr std::array<Code, 7> codes{"out-of-range", "wrong-size",   "not-a-number", "not-text",
                                    "bad-syntax",   "unknown-name", "no-column"};

[[noreturn]] void refuse_value(const std::string& who, const std::string& name,
                               const std::string& value, const std::string& allowed,
                               const std::string& hint, const std::string& code) {
  for (const auto& known : codes)
    if (known.name() == code) refuse(who, name, std::string_view(value), allowed, hint, known);
  throw std::logic_error(fmt::format("the package refuses with the code {}", code));
}

}  // namespace

void bind_inputs(py::module_& core) {
  core.def("read_number", &read_number, py::arg("who"), py::arg("name"), py::arg("value"));
  core.def("read_whole", &read_whole, py::arg("who"), py::arg("name"), py::arg("value"));
  core.def("read_text", &read_text, py::arg("who"), py::arg("name"), py::arg("value"));
  core.def("read_array", &read_array, py::arg("who"), py::arg("name"), py::arg("value"));
  core.def("read_vector", &read_vector, py::arg("who"), py::arg("name"), py::arg("value"));
  core.def("description", &description, py::arg("value"));
  core.def("refuse", &refuse_value, py::arg("who"), py::arg("name"), py::arg("value"),
           py::arg("allowed"), py::arg("hint") = "", py::arg("code") = "out-of-range");
}

}  // namespace clackers::python
