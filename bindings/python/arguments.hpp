#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "clackers/base/parameter.hpp"

/// What callers of Python give, read or refused in our words; and arrays to give back.
namespace clackers::python {

namespace py = pybind11;

using Doubles = py::array_t<double, py::array::c_style>;

/// A number: of Python or NumPy, no text and no boolean. Throws InputError (not-a-number).
double read_number(std::string_view who, std::string_view name, py::handle value);
/// A whole number. Throws InputError (not-whole).
long long read_whole(std::string_view who, std::string_view name, py::handle value);
/// A text. Throws InputError (not-text), also for one that UTF-8 cannot hold.
std::string read_text(std::string_view who, std::string_view name, py::handle value);

/// The parameters of a case: numbers, or the words of those that have words. Throws InputError
/// (not-a-number) for anything else.
Settings read_settings(std::string_view who, const py::dict& parameters);

/// Real numbers as contiguous doubles: `value` itself where it is such an array, else a copy of any
/// array-like of integers or floating-point numbers (a list, another dtype, not contiguous).
/// Throws InputError for text, booleans, complex numbers, objects, ragged lists and masked arrays.
Doubles read_array(std::string_view who, std::string_view name, py::handle value);

/// The same for one dimension; a number alone is one entry. Throws InputError (wrong-size) for more
/// dimensions.
Doubles read_vector(std::string_view who, std::string_view name, py::handle value);

/// Returns t [s], or throws InputError (time-outside) unless 0 <= t <= end.
double require_inside(std::string_view who, double t, double end);

/// An array that the library writes to: `value` itself. Throws InputError unless it is a writable,
/// contiguous array of doubles of this shape.
Doubles read_buffer(std::string_view who, std::string_view name, py::handle value, py::ssize_t rows,
                    py::ssize_t columns);

/// "array of float64 of shape (3, 2)", or the type's name, for messages.
std::string description(py::handle value);

inline std::span<const double> values_of(const Doubles& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}
inline std::span<double> place_of(Doubles& array) {
  return {array.mutable_data(), static_cast<std::size_t>(array.size())};
}

/// Copies that cannot be written to.
Doubles read_only(const Eigen::VectorXd& values);
Doubles read_only(const Eigen::MatrixXd& values);

}  // namespace clackers::python
