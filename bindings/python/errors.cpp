#include <pybind11/pybind11.h>

#include <exception>
#include <string_view>

#include "bindings/python/bind.hpp"
#include "clackers/base/error.hpp"

namespace clackers::python {
namespace {

// Raises the class `name` of clackers._errors with the text and the code of an error of the library.
void raise(const char* name, const Error& error) {
  const py::object type = py::module_::import("clackers._errors").attr(name);
  // A message may quote bytes that are no text.
  const std::string_view message = error.what();
  const auto text = py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(message.data(), py::ssize_t(message.size()), "replace"));
  const py::object raised = type(text, error.code().name());
  PyErr_SetObject(type.ptr(), raised.ptr());
}

}  // namespace

void bind_errors(py::module_&) {
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise("InputError", error);
    } catch (const FileError& error) {
      raise("FileError", error);
    } catch (const Error& error) {
      raise("Error", error);
    }
  });
}

}  // namespace clackers::python
