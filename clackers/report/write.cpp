#include "clackers/report/write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ostream>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "clackers/base/suggest.hpp"
#include "clackers/report/junit.hpp"
#include "clackers/report/latex.hpp"
#include "clackers/report/rows.hpp"
#include "clackers/report/runs.hpp"
#include "clackers/report/verdict_table.hpp"
#include "clackers/study/verify.hpp"

namespace clackers::report {

namespace {

[[noreturn]] void refuse_rows() {
  throw std::logic_error("rows have no format for verdicts; format_from(text) gives none");
}

}  // namespace

Format format_from(std::string_view text, Content content) {
  static const std::array<std::string, 6> names{"table", "csv", "json", "junit", "latex", "npy"};
  std::vector<std::string> known(names.begin(), names.begin() + 3);
  if (content == Content::numbers) known.push_back("npy");
  if (content == Content::verdicts) known.insert(known.end(), {"junit", "latex"});
  if (std::ranges::find(known, text) != known.end())
    return static_cast<Format>(std::ranges::find(names, text) - names.begin());
  refuse_name("format", text, known, fmt::format("{}", fmt::join(known, ", ")));
}

void write(study::RowSource& rows, Format format, std::ostream& out, const Style& style) {
  switch (format) {
    case Format::table:
      return write_table(rows, out, style);
    case Format::csv:
      return write_csv(rows, out);
    case Format::json:
      return write_json(rows, out);
    case Format::npy:
      return write_npy(rows, out);
    case Format::junit:
    case Format::latex:
      refuse_rows();
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

void write(const study::Record& record, Format format, std::ostream& out, const Style& style,
           const study::BaselineComparison* changes) {
  switch (format) {
    case Format::table:
      return write_verdict_table(record, out, style, changes);
    case Format::json:
      out << study::to_json(record) << '\n';
      return;
    case Format::csv: {
      const auto sheet = runs(record);
      study::SheetRows rows(sheet);
      return write_csv(rows, out);
    }
    case Format::npy:
      throw std::logic_error("verdicts have no npy; format_from(text) gives none");
    case Format::junit:
      return write_junit(record, out, changes);
    case Format::latex:
      return write_latex(record, out);
  }
}

}  // namespace clackers::report
