#include "clackers/report/check_rows.hpp"

#include <cmath>

#include "clackers/report/check_words.hpp"

namespace clackers::report {
namespace {

using study::Cell;

Cell number(double value) { return std::isnan(value) ? Cell() : Cell(value); }

std::vector<study::Column> columns(const study::CheckRecord& record) {
  std::vector<study::Column> list{
      {"file", "", "as given"},
      {"rows", "", "that were judged"},
      {"step", "s", "of the level"},
      {"step_source", "", "data (median spacing), name or option"},
      {"spacing", "s", "median time between rows"},
      {"first_time", "s", ""},
      {"last_time", "s", ""},
      {"digits", "", "most significant digits of a displacement"},
      {"printed_floor", "", "error in u that printing alone may make"},
      {"u_error", "", "largest |error in u| / initial envelope over masses and rows"},
      {"u_error_absolute", "m", "the same, not divided"},
      {"v_error", "", "L1 over time / length / initial envelope, largest over masses"},
      {"energy_error", "", "largest |E - E true| / E true at t = 0"},
      {"collision_source", "", "events, history (found in it) or unknown"},
      {"collisions_expected", "", "of the true motion up to the last row"},
      {"collisions_found", "", "reported, or found in the history"},
      {"collisions_matched", "", "nearest within a quarter of the time between neighbours"},
      {"collisions_missed", "", "true ones that match none"},
      {"collisions_extra", "", "found ones that match none"},
      {"collision_time_error", "s", "largest over the matched ones"}};
  for (const auto& metric : record.files.front().metrics)
    list.push_back({"metric:" + metric.name, metric.unit, "see clackers list metrics"});
  return list;
}

std::vector<Cell> row(const study::CheckedFile& file) {
  std::vector<Cell> cells{file.file,
                          file.rows,
                          file.score.step,
                          std::string(to_string(file.step_source)),
                          file.spacing,
                          file.first,
                          file.last,
                          static_cast<long long>(most_digits(file)),
                          file.printed_floor,
                          number(file.score.u_error),
                          number(file.score.u_error_absolute),
                          number(file.score.v_error),
                          number(file.score.energy_error),
                          std::string(to_string(file.collisions))};
  if (const auto& found = file.score.impacts) {
    for (const auto count :
         {found->expected, found->found, found->matched, found->missed, found->extra})
      cells.emplace_back(count);
    cells.push_back(found->matched > 0 ? Cell(found->worst_time_error) : Cell());
  } else {
    cells.resize(cells.size() + 6);
  }
  for (const auto& metric : file.metrics) cells.push_back(number(metric.value));
  return cells;
}

}  // namespace

study::Sheet check_rows(const study::CheckRecord& record) {
  study::Sheet sheet{study::CheckRecord::schema, "", columns(record), {}};
  for (const auto& file : record.files) {
    sheet.rows.push_back(row(file));
    sheet.rows.back().resize(sheet.columns.size());
  }
  return sheet;
}

}  // namespace clackers::report
