#include "clackers/report/rows/rows_numbers.hpp"

#include <fmt/compile.h>

#include <algorithm>
#include <cmath>

namespace clackers::report {
namespace {

// -1.7976931348623157e+308, and whole numbers below 2^63.
constexpr std::size_t longest_number = 24;

char* put(char* to, std::string_view text) { return std::copy(text.begin(), text.end(), to); }

}  // namespace

std::string_view NumberText::text(std::span<const double> values) {
  const std::size_t width = columns_.size(), rows = values.size() / width;
  const std::size_t cell =
      longest_number + marks_.between.size() + marks_.empty.size() + 2 * marks_.quote.size();
  text_.resize(rows * (width * cell + marks_.begin.size() + marks_.end.size()));
  char* to = text_.data();
  const double* value = values.data();
  for (std::size_t r = 0; r < rows; ++r) {
    to = put(to, marks_.begin);
    for (std::size_t c = 0; c < width; ++c, ++value) {
      if (c > 0) to = put(to, marks_.between);
      const auto kind = columns_[c].kind;
      if (kind == record::ColumnKind::side) {
        if (*value == 0.0) {
          to = put(to, marks_.empty);
        } else {
          to = put(to, marks_.quote);
          *to++ = *value < 0.0 ? '-' : '+';
          to = put(to, marks_.quote);
        }
      } else if (kind == record::ColumnKind::whole) {
        to = fmt::format_to(to, FMT_COMPILE("{}"), static_cast<long long>(*value));
      } else if (std::isfinite(*value)) {
        to = fmt::format_to(to, FMT_COMPILE("{}"), *value + 0.0);
      } else {
        to = put(to, marks_.quote);
        to = fmt::format_to(to, FMT_COMPILE("{}"), *value);
        to = put(to, marks_.quote);
      }
    }
    to = put(to, marks_.end);
  }
  return {text_.data(), static_cast<std::size_t>(to - text_.data())};
}

}  // namespace clackers::report
