#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <sstream>

#include "bindings/python/arguments.hpp"
#include "bindings/python/bind.hpp"
#include "clackers/base/check.hpp"
#include "clackers/report/columns.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/write.hpp"
#include "clackers/tables/listing.hpp"

namespace clackers::python {
namespace {

py::tuple read_sheet(const record::Sheet& sheet) {
  record::SheetRows rows(sheet);
  return read_rows(rows);
}

record::Cell cell_of(py::handle value) {
  if (value.is_none()) return {};
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::isinstance<py::int_>(value)) return value.cast<long long>();
  return value.cast<double>();
}

// Names, units and rows as the command prints them.
std::string table_text(const std::string& title,
                       const std::vector<std::pair<std::string, std::string>>& columns,
                       const std::vector<py::tuple>& rows, int width) {
  record::Sheet sheet{"", title, {}, {}};
  for (const auto& [name, unit] : columns) sheet.columns.push_back({name, unit, ""});
  for (const auto& row : rows) {
    auto& cells = sheet.rows.emplace_back();
    for (const auto value : row) cells.push_back(cell_of(value));
  }
  std::ostringstream out;
  record::SheetRows source(sheet);
  report::write(source, report::Format::table, out, {.width = width});
  return std::move(out).str();
}

// A cell as the command prints it.
std::string cell_text(py::handle value) {
  const auto cell = cell_of(value);
  if (const auto* real = std::get_if<double>(&cell)) return short_number(*real + 0.0);
  return cell.index() == 0 ? "" : py::str(value).cast<std::string>();
}

[[noreturn]] void refuse_unknown(const std::string& what, const std::string& given,
                                 const std::vector<std::string>& known) {
  refuse_name(what, given, known, fmt::format("{}", fmt::join(known, ", ")));
}

py::tuple listing(py::handle given) {
  const auto kind = read_text("catalogue", "kind", given);
  return read_sheet(kind == "columns" ? report::list_columns() : tables::list(kind));
}

py::tuple explain(py::handle code) {
  return read_sheet(tables::explain(code.is_none() ? "" : read_text("explain", "code", code)));
}

// What `clackers show` shows of a case, a table each.
py::list case_tables(const cases::Case& test_case, std::optional<double> share) {
  const double threshold = share.value_or(cases::default_threshold);
  py::list tables;
  for (const auto& sheet : tables::show_case(test_case.entry->name, test_case.values, threshold))
    tables.append(read_sheet(sheet));
  return tables;
}

std::vector<std::string> listing_kinds() {
  auto kinds = tables::list_kinds();
  kinds.emplace_back("columns");
  return kinds;
}

}  // namespace

void bind_tables(py::module_& core) {
  core.def("listing", &listing, py::arg("kind"));
  core.def("explain", &explain, py::arg("code"));
  core.def("case_tables", &case_tables, py::arg("case"), py::arg("threshold"));
  core.def("listing_kinds", &listing_kinds);
  core.def("cell_text", &cell_text, py::arg("cell"));
  core.def("refuse_name", &refuse_unknown, py::arg("what"), py::arg("given"), py::arg("known"));
  core.def("table_text", &table_text, py::arg("title"), py::arg("columns"), py::arg("rows"),
           py::arg("width"));
}

}  // namespace clackers::python
