#include <fmt/format.h>

#include <cmath>
#include <ostream>

#include "clackers/base/files/json.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/rows/rows_numbers.hpp"
#include "clackers/report/writers.hpp"

namespace clackers::report {
namespace {

struct JsonText {
  std::string operator()(std::monostate) const { return "null"; }
  std::string operator()(double value) const {
    return std::isfinite(value) ? exact_number(value + 0.0)  // no -0
                                : json_quoted(exact_number(value));
  }
  std::string operator()(long long value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& text) const { return json_quoted(text); }
};

void write_rows(record::RowSource& rows, std::ostream& out) {
  if (auto* const numbers = rows.numbers()) {
    std::string_view skipped = ",";  // the first row has none before it
    NumberText text(rows.columns(), {",\n  [", ", ", "]", "null", "\""});
    std::vector<double> values;
    while (out && numbers->next_block(values)) {
      out << text.text(values).substr(skipped.size());
      skipped = {};
    }
    return;
  }
  std::vector<record::Cell> row;
  const char* comma = "\n";
  while (out && rows.next(row)) {
    out << comma << "  [";
    const char* between = "";
    for (const auto& cell : row) {
      out << between << std::visit(JsonText{}, cell);
      between = ", ";
    }
    out << ']';
    comma = ",\n";
  }
}

}  // namespace

void write_json(record::RowSource& rows, std::ostream& out) {
  out << "{\n\"schema\": " << json_quoted(rows.schema())
      << ",\n\"title\": " << json_quoted(rows.title()) << ",\n\"columns\": [";
  const char* comma = "\n";
  for (const auto& column : rows.columns()) {
    out << comma << "  {\"name\": " << json_quoted(column.name)
        << ", \"unit\": " << json_quoted(column.unit)
        << ", \"meaning\": " << json_quoted(column.meaning) << '}';
    comma = ",\n";
  }
  out << "\n],\n\"rows\": [";
  write_rows(rows, out);
  out << "\n]\n}\n";
}

void write_json(std::span<const record::Sheet> sheets, std::string_view schema,
                std::string_view members, std::ostream& out) {
  out << "{\n\"schema\": " << json_quoted(schema);
  if (!members.empty()) out << ",\n" << members;
  out << ",\n\"sheets\": [";
  const char* comma = "\n";
  for (const auto& sheet : sheets) {
    out << comma;
    record::SheetRows rows(sheet);
    write_json(rows, out);
    comma = ",\n";
  }
  out << "]\n}\n";
}

}  // namespace clackers::report
