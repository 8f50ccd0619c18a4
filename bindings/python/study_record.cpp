#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <sstream>

#include "bindings/python/bind.hpp"
#include "clackers/base/error.hpp"
#include "clackers/record/record_json.hpp"
#include "clackers/report/columns.hpp"
#include "clackers/report/html/notebook.hpp"
#include "clackers/report/words/words.hpp"
#include "clackers/report/write.hpp"
#include "clackers/solvers/solver.hpp"

namespace clackers::python {
namespace {

using record::Record;
using record::Subject;
using report::Finding;

py::object number_or_none(bool is_known, double value) {
  return is_known ? py::object(py::float_(value)) : py::none();
}

std::string written(const Record& record, const std::string& format, int width) {
  std::ostringstream out;
  report::write(record, report::format_from(format, report::Content::verdicts), out,
                {.width = width});
  return std::move(out).str();
}

// Numbers that no run has are NaN, not None.
py::tuple read_run_sheet(record::Sheet sheet) {
  for (auto& column : sheet.columns) {
    const auto known = std::ranges::find(report::columns(), column.name, &report::Column::name);
    const bool is_metric = known == report::columns().end();
    if (is_metric || known->kind == report::Kind::number || known->kind == report::Kind::error)
      column.kind = record::ColumnKind::real;
  }
  record::SheetRows rows(sheet);
  return read_rows(rows);
}

py::list diagnoses(const Subject& subject) {
  py::list all;
  for (const auto& cause : subject.diagnoses) {
    py::dict evidence;
    for (const auto& fact : cause.evidence) evidence[py::str(fact.name)] = fact.value;
    all.append(py::make_tuple(cause.code, cause.value, cause.unit, cause.confidence, evidence,
                              report::diagnosis_text(cause).sentence));
  }
  return all;
}

std::vector<std::string> findings(const Subject& subject) {
  std::vector<std::string> all;
  for (const auto& cause : report::diagnosis_texts(subject)) all.push_back(text_of(cause));
  for (const auto& found : {report::finding(subject), report::false_convergence(subject)})
    if (found) all.push_back(text_of(*found));
  for (const auto& texts : {report::failure_texts(subject), report::note_texts(subject)})
    all.insert(all.end(), texts.begin(), texts.end());
  return all;
}

py::tuple level_rows(const record::CaseRecord& problem, const Subject& subject) {
  const auto table = report::level_table(problem, subject);
  record::Sheet sheet{"clackers/levels/1", "Levels of " + subject.name, {}, {}};
  for (const auto* column : table.columns)
    sheet.columns.push_back(
        {std::string(column->name), std::string(column->unit), std::string(column->meaning)});
  for (const auto& row : table.rows) {
    auto& cells = sheet.rows.emplace_back();
    for (const auto* column : table.columns) cells.push_back(column->get(row));
  }
  return read_run_sheet(sheet);
}

// Every run of one subject.
py::tuple run_rows(const record::CaseRecord& problem, const Subject& subject) {
  auto alone = problem;
  alone.subjects = {subject};
  return read_run_sheet(report::run_sheet({&alone, 1}));
}

py::dict subject_of(const record::CaseRecord& problem, const Subject& subject) {
  const auto& fit = subject.assessment.displacement;
  py::dict all;
  all["name"] = subject.name;
  all["kind"] = std::string(to_string(subject.kind));
  all["case"] = problem.problem.name;
  all["verdict"] = std::string(record::verdict_word(subject));
  all["behaviour"] = std::string(to_string(fit.behaviour));
  all["order"] = number_or_none(fit.has_line, fit.order);
  all["uncertainty"] = number_or_none(fit.has_line, fit.spread);
  const bool has_claim = subject.claim.behaviour != Behaviour::undecided;
  all["claim"] = has_claim ? py::object(py::str(report::claim_text(subject.claim))) : py::none();
  all["reason"] = subject.refusal.empty() ? subject.assessment.reason : subject.refusal_code;
  all["findings"] = findings(subject);
  all["diagnoses"] = diagnoses(subject);
  return all;
}

// Of the first solver whose runs all failed: (name, sentence, code, printed) of its first run, else None.
py::object failed_solver(const Record& record) {
  const auto failed = record::failed_solvers(record);
  if (failed.empty()) return py::none();
  const auto& run = *failed.front().first;
  return py::make_tuple(failed.front().subject->name, run.score.failure, run.score.failure_code,
                        run.printed);
}

const record::CaseRecord& case_at(const Record& record, std::size_t number) {
  return record.cases.at(number);
}

std::shared_ptr<Record> from_json(const std::string& text) {
  return std::make_shared<Record>(record::record_from_json(text));
}

}  // namespace

void bind_record(py::module_& core) {
  py::class_<Record, std::shared_ptr<Record>>(core, "Record")
      .def_static("from_json", &from_json, py::arg("text"),
                  py::call_guard<py::gil_scoped_release>())
      .def("to_json", &record::to_json, py::call_guard<py::gil_scoped_release>())
      .def("written", &written, py::arg("format"), py::arg("width"),
           py::call_guard<py::gil_scoped_release>())
      .def(
          "page", [](const Record& record) { return report::html(record); },
          py::call_guard<py::gil_scoped_release>())
      .def("notebook", &report::notebook_html)
      .def_property_readonly("command", [](const Record& record) { return record.command; })
      .def_property_readonly("interrupted", [](const Record& record) { return record.interrupted; })
      .def_property_readonly("exit_code", [](const Record& record) { return exit_code(record); })
      .def_property_readonly("verdict",
                             [](const Record& record) { return report::verdict_line(record).word; })
      .def_property_readonly("provenance",
                             [](const Record& record) {
                               const auto& from = record.provenance;
                               py::dict all;
                               all["command"] = from.command;
                               all["version"] = from.version;
                               all["compiler"] = from.compiler;
                               all["machine"] = from.machine;
                               all["processor"] = from.processor;
                               all["date"] = from.date;
                               return all;
                             })
      .def_property_readonly("subjects",
                             [](const Record& record) {
                               py::list all;
                               for (std::size_t c = 0; c < record.cases.size(); ++c)
                                 for (std::size_t s = 0; s < record.cases[c].subjects.size(); ++s) {
                                   auto entry =
                                       subject_of(record.cases[c], record.cases[c].subjects[s]);
                                   entry["place"] = py::make_tuple(c, s);
                                   all.append(entry);
                                 }
                               return all;
                             })
      .def("levels",
           [](const Record& record, std::size_t problem_index, std::size_t subject) {
             return level_rows(case_at(record, problem_index),
                               case_at(record, problem_index).subjects.at(subject));
           })
      .def("subject_runs",
           [](const Record& record, std::size_t problem_index, std::size_t subject) {
             return run_rows(case_at(record, problem_index),
                             case_at(record, problem_index).subjects.at(subject));
           })
      .def("runs",
           [](const Record& record) { return read_run_sheet(report::run_sheet(record.cases)); })
      .def("failed_solver", &failed_solver)
      .def_property_readonly(
          "cases",
          [](const Record& record) {
            py::list names;
            for (const auto& problem : record.cases)
              names.append(py::make_tuple(problem.problem.name, report::case_text(problem.problem),
                                          report::figure_names(problem)));
            return names;
          })
      .def("figure", [](const Record& record, std::size_t problem_index, const std::string& name) {
        return report::notebook_figure(case_at(record, problem_index), name);
      });
}

}  // namespace clackers::python
