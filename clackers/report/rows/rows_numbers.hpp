#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "clackers/record/sheet.hpp"

namespace clackers::report {

/// What surrounds the numbers of a row in a text format.
struct RowMarks {
  std::string_view begin, between, end;
  std::string_view empty;  ///< a cell without value
  std::string_view quote;  ///< around text, and around what is no finite number; may be empty
};

/// Writes blocks of rows as text, the fast way: the shortest numbers that read back to the same
/// double, -0 as 0.
class NumberText {
 public:
  NumberText(const std::vector<record::Column>& columns, const RowMarks& marks)
      : columns_(columns), marks_(marks) {}

  /// The text of `values`, row-major. Valid until the next call.
  std::string_view text(std::span<const double> values);

 private:
  const std::vector<record::Column>& columns_;
  RowMarks marks_;
  std::vector<char> text_;
};

}  // namespace clackers::report
