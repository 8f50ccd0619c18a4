#include "bindings/python/arguments.hpp"

#include <fmt/format.h>

#include <string>

#include "clackers/base/error.hpp"

namespace clackers::python {
namespace {

constexpr auto array_rule = "an array or list of real numbers";

std::string shape_text(const py::array& array) {
  return py::str(py::tuple(array.attr("shape"))).cast<std::string>();
}

bool is_real(const py::array& array) {
  const char kind = array.dtype().kind();
  return kind == 'f' || kind == 'i' || kind == 'u';
}

// The value as a person would write it, with its type.
std::string given(py::handle value) {
  return fmt::format("{} ({})", py::repr(value).cast<std::string>(), description(value));
}

void refuse_masked(std::string_view who, std::string_view name, py::handle value) {
  if (!py::hasattr(value, "mask") || !py::hasattr(value, "filled")) return;
  refuse(who, name, "a masked array", array_rule,
         "What stands below a mask is no number; take the valid entries, x.compressed().",
         "not-a-number");
}

template <class Matrix>
Doubles read_only_copy(const Matrix& values, std::vector<py::ssize_t> shape) {
  Doubles array(std::move(shape));
  auto* to = array.mutable_data();
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j) *to++ = values(i, j);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

}  // namespace

std::string description(py::handle value) {
  if (!py::isinstance<py::array>(value))
    return fmt::format("an object of type {}",
                       py::str(py::type::handle_of(value).attr("__name__")).cast<std::string>());
  const auto array = py::reinterpret_borrow<py::array>(value);
  return fmt::format("an array of {} of shape {}", py::str(array.dtype()).cast<std::string>(),
                     shape_text(array));
}

double read_number(std::string_view who, std::string_view name, py::handle value) {
  const bool is_number = PyFloat_Check(value.ptr()) || PyIndex_Check(value.ptr()) ||
                         py::isinstance(value, py::module_::import("numpy").attr("floating"));
  const double number =
      is_number && !PyBool_Check(value.ptr()) ? PyFloat_AsDouble(value.ptr()) : -1.0;
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    refuse(who, name, py::str(value).cast<std::string>(), "a number below 1.8e308");
  }
  if (!is_number || PyBool_Check(value.ptr()))
    refuse(who, name, given(value), "a number", {}, "not-a-number");
  return number;
}

long long read_whole(std::string_view who, std::string_view name, py::handle value) {
  if (!PyIndex_Check(value.ptr()) || PyBool_Check(value.ptr()))
    refuse(who, name, given(value), "a whole number", {}, "not-whole");
  const auto whole = PyLong_AsLongLong(value.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    refuse(who, name, py::str(value).cast<std::string>(), "a whole number below 2^63");
  }
  return whole;
}

std::string read_text(std::string_view who, std::string_view name, py::handle value) {
  if (!py::isinstance<py::str>(value)) refuse(who, name, given(value), "a text", {}, "not-text");
  return value.cast<std::string>();
}

Doubles read_array(std::string_view who, std::string_view name, py::handle value) {
  refuse_masked(who, name, value);
  const auto array = py::array::ensure(value);
  if (!array)
    refuse(who, name, description(value), array_rule, "Rows must have equal length.", "wrong-size");
  if (!is_real(array)) {
    const auto given = py::isinstance<py::array>(value)
                           ? description(value)
                           : fmt::format("{}, read as {}", description(value), description(array));
    refuse(who, name, given, array_rule, {}, "not-a-number");
  }
  return Doubles::ensure(array);
}

Doubles read_vector(std::string_view who, std::string_view name, py::handle value) {
  auto array = read_array(who, name, value);
  if (array.ndim() == 0) return Doubles(array.reshape({1}));
  if (array.ndim() != 1) refuse(who, name, description(array), "one dimension", {}, "wrong-size");
  return array;
}

Doubles read_buffer(std::string_view who, std::string_view name, py::handle value, py::ssize_t rows,
                    py::ssize_t columns) {
  const auto rule =
      fmt::format("a writable, C-contiguous array of float64 of shape ({}, {})", rows, columns);
  if (!py::isinstance<Doubles>(value))
    refuse(who, name, description(value), rule, "It is written to directly and cannot be a copy.");
  auto array = py::reinterpret_borrow<Doubles>(value);
  if (!array.writeable()) refuse(who, name, "a read-only array", rule);
  if (array.ndim() != 2 || array.shape(0) != rows || array.shape(1) != columns)
    refuse(who, name, description(array), rule, {}, "wrong-size");
  return array;
}

Doubles read_only(const Eigen::VectorXd& values) { return read_only_copy(values, {values.size()}); }

Doubles read_only(const Eigen::MatrixXd& values) {
  return read_only_copy(values, {values.rows(), values.cols()});
}

}  // namespace clackers::python
