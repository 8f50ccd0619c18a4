#include "clackers/report/write.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "clackers/base/check.hpp"
#include "clackers/record/record_json.hpp"
#include "clackers/report/columns.hpp"
#include "clackers/report/text/plot.hpp"
#include "clackers/report/writers.hpp"

namespace clackers::report {
namespace {

using RowWriter = void (*)(record::RowSource&, std::ostream&, const Style&);
using RecordWriter = void (*)(const record::Record&, std::ostream&, const Style&,
                              const study::BaselineComparison*);

void write_runs(const record::Record& record, std::ostream& out, const Style&,
                const study::BaselineComparison*) {
  const auto sheet = run_sheet(record.cases);
  record::SheetRows rows(sheet);
  write_csv(rows, out);
}

void write_record_json(const record::Record& record, std::ostream& out, const Style&,
                       const study::BaselineComparison*) {
  out << record::to_json(record) << '\n';
}

struct FormatRow {
  Format format;
  std::string name;
  std::string_view note;  ///< for the help
  RowWriter rows;         ///< nullptr: rows do not have it
  RecordWriter record;    ///< nullptr: records do not have it
  bool shows_changes;     ///< since a baseline
  bool numbers = false;   ///< of rows only where all are numbers
};

/// All formats; a new one is a row here and its writer.
const FormatRow table[] = {
    {Format::table, "table", "for people, 80 columns", write_table, write_text, true},
    {Format::csv, "csv", "numbers read back to the same double",
     [](auto& rows, auto& out, auto&) { write_csv(rows, out); }, write_runs, false},
    {Format::json, "json", "the same", [](auto& rows, auto& out, auto&) { write_json(rows, out); },
     write_record_json, false},
    {Format::npy, "npy", "a NumPy structured array of float64, one field a column",
     [](auto& rows, auto& out, auto&) { write_npy(rows, out); }, nullptr, false, true},
    {Format::junit, "junit", "XML for continuous integration", nullptr, write_junit, true},
    {Format::latex, "latex", "tables", nullptr, write_latex, false},
};

const FormatRow& row_of(Format format) {
  const auto* found = std::ranges::find(table, format, &FormatRow::format);
  if (found == std::end(table)) throw std::logic_error("a format without a row");
  return *found;
}

bool has(const FormatRow& row, Content content) {
  if (content == Content::verdicts) return row.record != nullptr;
  return row.rows != nullptr && (content == Content::numbers || !row.numbers);
}

}  // namespace

std::vector<FormatNote> formats_of(Content content) {
  std::vector<FormatNote> notes;
  for (const auto& row : table)
    if (has(row, content)) notes.push_back({row.name, row.note});
  return notes;
}

Format format_from(std::string_view text, Content content) {
  std::vector<std::string> names;
  for (const auto& row : table) {
    if (!has(row, content)) continue;
    if (row.name == text) return row.format;
    names.push_back(row.name);
  }
  refuse_name("format", text, names, fmt::format("{}", fmt::join(names, ", ")));
}

bool shows_changes(Format format) { return row_of(format).shows_changes; }

void write(record::RowSource& rows, Format format, std::ostream& out, const Style& style) {
  const auto writer = row_of(format).rows;
  if (writer == nullptr) throw std::logic_error("rows do not have this format");
  writer(rows, out, style);
}

void write(std::span<const record::Sheet> sheets, std::string_view schema, Format format,
           std::ostream& out, const Style& style, std::string_view members) {
  if (format == Format::json) return write_json(sheets, schema, members, out);
  const char* between = "";
  for (const auto& sheet : sheets) {
    out << between;
    record::SheetRows rows(sheet);
    if (sheet.curves && format == Format::table)
      out << curves(sheet, style);
    else
      write(rows, format, out, style);
    between = "\n";
  }
}

void write(const record::Record& record, Format format, std::ostream& out, const Style& style,
           const study::BaselineComparison* changes) {
  const auto writer = row_of(format).record;
  if (writer == nullptr) throw std::logic_error("records do not have this format");
  writer(record, out, style, changes);
}

}  // namespace clackers::report
