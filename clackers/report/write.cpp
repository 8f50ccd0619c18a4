#include "clackers/report/write.hpp"

#include <array>
#include <ostream>

#include "clackers/base/suggest.hpp"
#include "clackers/report/rows.hpp"
#include "clackers/report/runs.hpp"
#include "clackers/report/verdict_table.hpp"
#include "clackers/study/verify.hpp"

namespace clackers::report {

Format format_from(std::string_view text) {
  if (text == "table") return Format::table;
  if (text == "csv") return Format::csv;
  if (text == "json") return Format::json;
  static const std::array<std::string, 3> names{"table", "csv", "json"};
  refuse_name("format", text, names, "table, csv, json");
}

void write(study::RowSource& rows, Format format, std::ostream& out, const Style& style) {
  switch (format) {
    case Format::table:
      return write_table(rows, out, style);
    case Format::csv:
      return write_csv(rows, out);
    case Format::json:
      return write_json(rows, out);
  }
}

void write(std::span<const study::Sheet> sheets, std::string_view schema, Format format,
           std::ostream& out, const Style& style) {
  if (format == Format::json) return write_json(sheets, schema, out);
  const char* between = "";
  for (const auto& sheet : sheets) {
    out << between;
    study::SheetRows rows(sheet);
    write(rows, format, out, style);
    between = "\n";
  }
}

void write(const study::Record& record, Format format, std::ostream& out, const Style& style) {
  switch (format) {
    case Format::table:
      return write_verdict_table(record, out, style);
    case Format::json:
      out << study::to_json(record) << '\n';
      return;
    case Format::csv: {
      const auto sheet = runs(record);
      study::SheetRows rows(sheet);
      return write_csv(rows, out);
    }
  }
}

}  // namespace clackers::report
