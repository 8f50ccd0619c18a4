#include "clackers/report/check_report.hpp"

#include <ostream>

#include "clackers/report/check_json.hpp"
#include "clackers/report/check_junit.hpp"
#include "clackers/report/check_latex.hpp"
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
      return write_check_junit(record, out);
    case Format::npy:  // has no place for verdicts; format_from gives none
      return;
    case Format::latex:
      return write_check_latex(record, out);
  }
}

}  // namespace clackers::report
