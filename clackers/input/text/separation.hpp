#pragma once

#include <string_view>
#include <vector>

namespace clackers::input {

/// What stands between the fields of a row: a comma, a semicolon or a tab, one between two fields,
/// or any run of blanks and tabs.
class Separation {
 public:
  /// What separates the fields of a row of numbers.
  static Separation of(std::string_view row);

  /// The fields without blanks around them, into `fields`. An empty field behind the last separator
  /// is left out.
  void split(std::string_view line, std::vector<std::string_view>& fields) const;

  bool is_comma() const { return mark_ == ','; }

 private:
  explicit Separation(char mark) : mark_(mark) {}

  char mark_;  ///< ' ' stands for a run of blanks and tabs
};

/// `text` without blanks, tabs and quotes around it.
std::string_view trimmed(std::string_view text);

}  // namespace clackers::input
