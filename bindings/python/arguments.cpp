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
  constexpr Py_ssize_t most_shown = 200;
  if (const auto shown = py::reinterpret_steal<py::object>(PyObject_Repr(value.ptr()))) {
    const auto start =
        py::reinterpret_steal<py::object>(PyUnicode_Substring(shown.ptr(), 0, most_shown));
    return fmt::format("{}{} ({})", start.cast<std::string>(),
                       PyUnicode_GetLength(shown.ptr()) > most_shown ? "..." : "",
                       description(value));
  }
  PyErr_Clear();  // of an object whose own repr() raises
  return description(value);
}

py::object numpy(const char* name) { return py::module_::import("numpy").attr(name); }

bool is_instance(py::handle value, const char* type) { return py::isinstance(value, numpy(type)); }

bool is_whole(py::handle value) {
  return (PyLong_Check(value.ptr()) && !PyBool_Check(value.ptr())) || is_instance(value, "integer");
}

bool is_aligned(py::handle array) {
  namespace api = py::detail;
  return (api::array_proxy(array.ptr())->flags & api::npy_api::NPY_ARRAY_ALIGNED_) != 0;
}

// An array of NumPy, and of no class derived from it, that can be read as it is.
bool is_plain(py::handle value) {
  return Py_TYPE(value.ptr()) == py::detail::npy_api::get().PyArray_Type_ &&
         py::isinstance<Doubles>(value) && is_aligned(value);
}

void refuse_masked(std::string_view who, std::string_view name, py::handle value) {
  if (!py::hasattr(value, "mask") || !py::hasattr(value, "filled")) return;
  refuse(who, name, "a masked array", array_rule,
         "What stands below a mask is no number; take the valid entries, x.compressed().",
         "not-a-number");
}

Doubles read_only_copy(const auto& values, std::vector<py::ssize_t> shape) {
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
  if (!PyFloat_Check(value.ptr()) && !is_whole(value) && !is_instance(value, "floating"))
    refuse(who, name, given(value), "a number", "A number of another type: float(x).",
           "not-a-number");
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() == nullptr) return number;
  PyErr_Clear();
  refuse(who, name, "a whole number of more than 308 digits", "a finite number", {}, "not-finite");
}

long long read_whole(std::string_view who, std::string_view name, py::handle value) {
  if (!is_whole(value)) refuse(who, name, given(value), "a whole number", {}, "not-whole");
  int overflow = 0;
  const auto whole = PyLong_AsLongLongAndOverflow(
      py::int_(py::reinterpret_borrow<py::object>(value)).ptr(), &overflow);
  if (overflow != 0) refuse(who, name, given(value), "a whole number between -2^63 and 2^63");
  return whole;
}

Settings read_settings(std::string_view who, const py::dict& parameters) {
  Settings settings;
  for (const auto& [key, value] : parameters) {
    const auto name = read_text(who, "name of a parameter", key);
    if (py::isinstance<py::str>(value))
      settings.emplace_back(name, read_text(who, name, value));
    else
      settings.emplace_back(name, read_number(who, name, value));
  }
  return settings;
}

std::string read_text(std::string_view who, std::string_view name, py::handle value) {
  if (!py::isinstance<py::str>(value)) refuse(who, name, given(value), "a text", {}, "not-text");
  Py_ssize_t size = 0;
  if (const char* text = PyUnicode_AsUTF8AndSize(value.ptr(), &size);
      text != nullptr && std::string_view(text).size() == std::size_t(size))
    return text;
  PyErr_Clear();
  refuse(who, name, given(value), "a text without NUL and halves of surrogate pairs", {},
         "not-text");
}

Doubles read_array(std::string_view who, std::string_view name, py::handle value) {
  if (is_plain(value)) return py::reinterpret_borrow<Doubles>(value);
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
  return numpy("require")(array, "float64", "CA");
}

double require_inside(std::string_view who, double t, double end) {
  if (!(t >= 0.0 && t <= end))
    refuse(who, "t", t, fmt::format("0 <= t <= {} s, the run of the case", end),
           "A longer run is another value of t_end or a_t.", "time-outside");
  return t;
}

Doubles read_vector(std::string_view who, std::string_view name, py::handle value) {
  auto array = read_array(who, name, value);
  if (array.ndim() == 0) return Doubles(array.reshape({1}));
  if (array.ndim() != 1) refuse(who, name, description(array), "one dimension", {}, "wrong-size");
  return array;
}

Doubles read_buffer(std::string_view who, std::string_view name, py::handle value, py::ssize_t rows,
                    py::ssize_t columns) {
  const auto rule = fmt::format(
      "a writable, aligned, C-contiguous array of float64 of shape ({}, {})", rows, columns);
  if (!py::isinstance<Doubles>(value) || !is_aligned(value))
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
