#include "clackers/report/check_report.hpp"

#include <ostream>
#include <stdexcept>

#include "clackers/report/check_json.hpp"
#include "clackers/report/check_rows.hpp"
#include "clackers/report/check_table.hpp"
#include "clackers/report/rows.hpp"

namespace clackers::report {

void write(const study::CheckRecord& record, Format format, std::ostream& out, const Style& style) {
  switch (format) {
    case Format::table:
      return write_check_table(record, out, style);
    case Format::json:
      out << check_json(record) << '\n';
      return;
    case Format::csv: {
      const auto sheet = check_rows(record);
      study::SheetRows rows(sheet);
      return write_csv(rows, out);
    }
    case Format::junit:
    case Format::latex:
      throw std::logic_error("histories have no format for verdicts; format_from(text) gives none");
  }
}

}  // namespace clackers::report
