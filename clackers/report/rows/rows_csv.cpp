#include <fmt/format.h>

#include <ostream>

#include "clackers/report/format.hpp"
#include "clackers/report/rows/rows_numbers.hpp"
#include "clackers/report/writers.hpp"

namespace clackers::report {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out.append(c == '"' ? 2 : 1, c);
  return out + '"';
}

struct CsvText {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(double value) const { return exact_number(value + 0.0); }  // no -0
  std::string operator()(long long value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& text) const { return quoted(text); }
};

}  // namespace

void write_csv(record::RowSource& rows, std::ostream& out) {
  const char* comma = "";
  for (const auto& column : rows.columns()) {
    out << comma << quoted(column.name);
    comma = ",";
  }
  out << '\n';
  if (auto* const numbers = rows.numbers()) {
    NumberText text(rows.columns(), {"", ",", "\n", "", ""});
    std::vector<double> values;
    while (out && numbers->next_block(values)) out << text.text(values);
    return;
  }
  std::vector<record::Cell> row;
  while (out && rows.next(row)) {
    comma = "";
    for (const auto& cell : row) {
      out << comma << std::visit(CsvText{}, cell);
      comma = ",";
    }
    out << '\n';
  }
}

}  // namespace clackers::report
