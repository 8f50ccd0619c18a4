#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace clackers::input {

/// A Python literal, as the header of a NumPy file is one.
struct PythonLiteral {
  using List = std::vector<PythonLiteral>;  ///< a list or a tuple
  struct Dictionary {
    std::vector<std::string> keys;
    List values;  ///< one a key
  };

  std::variant<bool, long long, std::string, List, Dictionary> value;

  /// The value of this type, or nullptr where it is of another one.
  template <class Type>
  const Type* as() const {
    return std::get_if<Type>(&value);
  }
};

/// Reads True, False, whole numbers (at most 18 digits), strings without escapes other than \\, \'
/// and \", tuples, lists, and dictionaries whose keys are strings, nested at most 16 deep. Throws
/// InputError (not-an-array) for any other text; `name` is that of the file in its message.
PythonLiteral read_python_literal(const std::string& name, std::string_view text);

}  // namespace clackers::input
