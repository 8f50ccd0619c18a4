#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "clackers/base/codes.hpp"

namespace clackers {

/// Root of everything the library throws on purpose. `what()` is the sentence for a person,
/// `code()` the stable name for a program.
class Error : public std::runtime_error {
 public:
  Error(const std::string& message, Code code) : std::runtime_error(message), code_(code) {}
  Code code() const { return code_; }

 private:
  Code code_;
};

/// Refused input: the caller is at fault, nothing was done. Exit code 2 of the command.
class InputError : public Error {
  using Error::Error;
};

/// A file, disk or external program failed. Exit code 4 of the command.
class FileError : public Error {
  using Error::Error;
};

/// Composes "who: name = value; allowed: rule. hint" and throws it as InputError.
[[noreturn]] void refuse(std::string_view who, std::string_view name, double value,
                         std::string_view allowed, std::string_view hint = {},
                         Code code = "out-of-range");
/// The same for a value that is text.
[[noreturn]] void refuse(std::string_view who, std::string_view name, std::string_view value,
                         std::string_view allowed, std::string_view hint = {},
                         Code code = "out-of-range");

}  // namespace clackers
