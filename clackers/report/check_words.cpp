#include "clackers/report/check_words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clackers::report {

int most_digits(const study::CheckedFile& file) {
  int digits = 0;
  for (const auto& column : file.columns)
    if (column.name.starts_with('u')) digits = std::max(digits, column.digits);
  return digits;
}

std::string digits_text(const study::CheckedFile& file) {
  const auto is_single = [](const study::PrintedColumn& column) {
    return column.name.starts_with('u') && column.single;
  };
  return std::ranges::any_of(file.columns, is_single) ? "single"
                                                      : fmt::format("{}", most_digits(file));
}

}  // namespace clackers::report
