#include "clackers/campaign/tasks.hpp"

#include <cmath>
#include <utility>

#include "clackers/base/number.hpp"
#include "clackers/campaign/tasks/prepared_system.hpp"
#include "clackers/report/columns.hpp"
#include "clackers/solvers/program.hpp"
#include "clackers/study/check.hpp"

namespace clackers::campaign {
namespace {

using record::Cell;
using record::ColumnKind;

// Nobody waits for a run of a campaign, and other work may slow the machine down.
constexpr double timeout_of_run = 600.0;  // [s]

// Processor times differ from run to run and stand in a table of their own; what was reused does, too.
bool is_kept(const report::Column& column) {
  return column.in_rows && column.name != "seconds" && column.name != "reused";
}

ColumnKind kind_of(report::Kind kind) {
  if (kind == report::Kind::count) return ColumnKind::whole;
  return is_number(kind) ? ColumnKind::real : ColumnKind::any;
}

record::Column column_of(const report::Column& column) {
  return {std::string(column.name), std::string(column.unit), std::string(column.meaning),
          kind_of(column.kind)};
}

bool is_number_everywhere(const Specification& specification, const std::string& parameter) {
  for (const auto& systems : specification.cases())
    for (const auto& axis : systems.axes)
      for (const auto& value : axis.listed)
        if (axis.name == parameter && value.is_word()) return false;
  return true;
}

Cell cell(const ParameterValue& value) {
  return value.is_word() ? Cell(value.text()) : Cell(double(value));
}

// As the database gives it back: the digits of a file are a number, or the word "single".
Cell cell(const report::Column& column, const report::Row& row) {
  auto value = column.get(row);
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr || kind_of(column.kind) == ColumnKind::any) return value;
  const auto number = whole_number(*text);
  return number ? Cell(*number) : value;
}

std::vector<Cell> subject_cells(const Specification& specification, const System& system,
                                const report::Row& row) {
  std::vector<Cell> cells{system.number};
  for (const auto& name : specification.parameters()) {
    auto& added = cells.emplace_back();
    for (const auto& [set, value] : system.settings)
      if (set == name) added = cell(value);
  }
  for (const auto& column : report::columns())
    if (is_kept(column)) cells.push_back(cell(column, row));
  return cells;
}

std::vector<Cell> run_cells(const Specification& specification, const report::Row& row) {
  std::vector<Cell> cells;
  for (const auto& column : report::columns())
    if (is_kept(column) && !is_of_subject(column)) cells.push_back(cell(column, row));
  for (const auto& name : specification.metrics()) {
    auto& added = cells.emplace_back();
    for (const auto& metric : row.run->metrics)
      if (metric.name == name && !std::isnan(metric.value)) added = metric.value;
  }
  return cells;
}

solvers::SolverSubject solver_of(const Specification& specification, const MethodEntry& method) {
  solvers::ProcessOptions options;
  options.tolerances = specification.ladder().tolerances;
  options.timeout = timeout_of_run;
  if (!method.expect.empty()) options.expect = study::claim_from(method.expect);
  auto subject =
      std::move(solvers::subjects_of(
                    solvers::ProgramRequest{options, {{method.text, method.name, method.labels}}})
                    .front());
  subject.steps = method.steps;
  return subject;
}

}  // namespace

Tables tables_of(const Specification& specification) {
  const record::Column task{"task", "", "number of the task, from 0", ColumnKind::whole};
  Tables tables;
  tables.subjects = {task, {"system", "", "number of the system, from 0", ColumnKind::whole}};
  for (const auto& name : specification.parameters())
    tables.subjects.push_back(
        {"set_" + name, "", "parameter that the specification sets",
         is_number_everywhere(specification, name) ? ColumnKind::real : ColumnKind::any});
  tables.runs = {task, {"run", "", "from 1, the first of the coarsest level", ColumnKind::whole}};
  for (const auto& column : report::columns()) {
    if (!is_kept(column)) continue;
    tables.subjects.push_back(column_of(column));
    if (!is_of_subject(column)) tables.runs.push_back(column_of(column));
  }
  for (const auto& name : specification.metrics())
    tables.runs.push_back({"metric:" + name, "", "see clackers list metrics", ColumnKind::real});
  return tables;
}

std::vector<std::optional<solvers::SolverSubject>> solvers_of(const Specification& specification) {
  std::vector<std::optional<solvers::SolverSubject>> solvers;
  for (const auto& method : specification.methods()) {
    auto& added = solvers.emplace_back();
    if (method.kind != MethodEntry::Kind::catalogue) added = solver_of(specification, method);
  }
  return solvers;
}

TaskRunner::TaskRunner(const Specification& specification,
                       const std::vector<std::optional<solvers::SolverSubject>>& solvers)
    : specification_(specification), solvers_(solvers) {}

TaskRunner::~TaskRunner() = default;

std::optional<TaskRows> TaskRunner::run(long long task, const std::atomic<bool>* interrupt) {
  const auto methods = static_cast<long long>(specification_.methods().size());
  const auto number = task / methods;
  const auto method = static_cast<std::size_t>(task % methods);
  if (!prepared_ || prepared_->system().number != number)
    prepared_ = std::make_unique<PreparedSystem>(specification_, specification_.system(number));
  const auto* record =
      prepared_->assess(specification_.methods()[method], solvers_[method], interrupt);
  if (record == nullptr) return {};
  const auto& subject = record->subjects.front();
  TaskRows rows;
  rows.task = task;
  rows.subject =
      subject_cells(specification_, prepared_->system(), report::subject_row(*record, subject));
  for (std::size_t level = 0; level < subject.levels.size(); ++level)
    for (const auto& run : subject.levels[level].runs) {
      rows.runs.push_back(
          run_cells(specification_, report::run_row(*record, subject, int(level) + 1, run)));
      rows.seconds.push_back(run.score.seconds);
    }
  return rows;
}

}  // namespace clackers::campaign
