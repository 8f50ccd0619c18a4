#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "bindings/python/arguments.hpp"
#include "bindings/python/bind.hpp"
#include "bindings/python/caller_thread.hpp"
#include "bindings/python/study_solver.hpp"
#include "clackers/base/error.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/solvers/program.hpp"
#include "clackers/solvers/solver.hpp"
#include "clackers/study/check.hpp"
#include "clackers/study/check/against.hpp"
#include "clackers/study/options.hpp"
#include "clackers/study/verify.hpp"

namespace clackers::python {
namespace {

// (name, parameters) of a case.
using CaseChoice = std::pair<std::string, py::dict>;
// (command, timeout, work, fresh, environment) of a program.
using GivenProgram = std::tuple<std::string, double, std::string, bool, std::vector<std::string>>;
// (name, program or callable, steps, tolerances).
using GivenSolver = std::tuple<std::string, std::variant<GivenProgram, py::object>,
                               std::vector<double>, std::vector<double>>;

// (reader, nodes, component) of result files.
using GivenResults = std::tuple<std::string, std::vector<std::string>, std::string>;

input::ResultChoice choice_of(const GivenResults& given) {
  return input::result_choice(std::get<0>(given), std::get<1>(given), std::get<2>(given),
                              "component");
}

// Runs a study in the caller's thread: (record, exception of Python that ended it), either None. A
// study that leaves no record when it is interrupted throws Error (interrupted).
py::tuple result_of(CallerThread& caller, const py::object& progress, const auto& make) {
  std::shared_ptr<std::invoke_result_t<decltype(make), const Progress&>> record;
  try {
    caller.run(progress, [&](const Progress& report) {
      record = std::make_shared<typename decltype(record)::element_type>(make(report));
    });
  } catch (const Error& error) {
    if (error.code() != Code("interrupted")) throw;
  }
  return py::make_tuple(record, caller.stopped_by());
}

// Numbers by the names of study::verify_options(); None is not given.
std::map<std::string, double> read_options(const py::dict& given) {
  std::map<std::string, double> numbers;
  for (const auto& option : study::verify_options())
    for (auto name : {std::string(option.former), std::string(option.name)}) {
      std::ranges::replace(name, '-', '_');
      if (!given.contains(name) || given[name.c_str()].is_none()) continue;
      const py::object value = given[name.c_str()];
      const bool is_whole = option.kind == study::VerifyOption::Kind::whole;
      const double number =
          is_whole ? double(read_whole("verify", name, value)) : read_number("verify", name, value);
      if (is_whole && !(number >= 1.0 && number <= option.most))
        refuse("verify", name, number, "1 to " + std::to_string(option.most));
      numbers[std::string(option.name)] = number;
    }
  return numbers;
}

solvers::SolverSubject program_subject(const GivenSolver& subject,
                                       const std::optional<Claim>& claim) {
  const auto& [name, program, steps, tolerances] = subject;
  const auto& [command, timeout, work, fresh, environment] = std::get<GivenProgram>(program);
  auto made = solvers::subjects_of(
      {{claim, tolerances, timeout, work, fresh, environment}, {{command, name}}});
  made[0].steps = steps;
  return std::move(made[0]);
}

py::tuple verify(const std::vector<std::string>& methods, const std::vector<GivenSolver>& solvers,
                 const std::vector<CaseChoice>& chosen, const std::optional<std::string>& expect,
                 const py::dict& options, const std::string& command, const py::object& progress) {
  study::VerifyRequest request;
  request.methods = methods;
  for (const auto& choice : chosen) {
    request.cases.push_back(choice.first.empty() ? std::string(cases::default_case())
                                                 : choice.first);
    request.case_settings.push_back(read_settings("case", choice.second));
  }
  study::set_options(request, read_options(options));
  request.command = command;
  std::optional<Claim> claim;
  if (expect) claim = study::claim_from(*expect);
  std::list<CallableSubject> callables;  // a list: subjects refer to them
  CallerThread caller;
  for (const auto& subject : solvers) {
    const auto& [name, run, steps, tolerances] = subject;
    if (const auto* callable = std::get_if<py::object>(&run))
      request.solvers.push_back(solver_subject(
          callables.emplace_back(CallableSubject{name, *callable, claim, steps, tolerances}),
          caller));
    else
      request.solvers.push_back(program_subject(subject, claim));
  }
  return result_of(caller, progress, [&](const Progress& report) {
    return study::verify(request, report, caller.interrupt());
  });
}

py::tuple check(const std::vector<std::pair<std::string, py::list>>& subjects,
                const py::list& events, const CaseChoice& chosen, const std::vector<double>& steps,
                const std::vector<double>& tolerances, const std::vector<std::string>& columns,
                const std::optional<std::string>& expect, std::optional<double> tolerance,
                const GivenResults& results, const std::string& command,
                const py::object& progress) {
  study::CheckRequest request;
  request.results = choice_of(results);
  request.subjects.clear();
  for (const auto& [name, histories] : subjects) {
    auto& subject = request.subjects.emplace_back(study::NamedHistories{{}, name});
    for (const auto history : histories) subject.files.push_back(source_of(history));
  }
  for (const auto list : events) request.events.push_back(source_of(list));
  request.case_name = chosen.first;
  request.settings = read_settings("case", chosen.second);
  request.steps = steps;
  request.tolerances = tolerances;
  request.columns = columns;
  if (expect) request.expect = study::claim_from(*expect);
  request.tolerance = tolerance;
  request.command = command;
  CallerThread caller;
  return result_of(caller, progress, [&](const Progress& report) {
    return study::check(request, report, caller.interrupt());
  });
}

// (comparison, exception of Python that ended it), either None.
py::tuple compare(const py::list& first, const py::list& second, const std::vector<double>& steps,
                  const std::vector<double>& tolerances, const std::vector<std::string>& columns,
                  std::optional<double> tolerance, const GivenResults& results) {
  study::AgainstRequest request{{}, columns, steps, tolerances, tolerance, choice_of(results)};
  for (const auto history : first) request.sets[0].push_back(source_of(history));
  for (const auto history : second) request.sets[1].push_back(source_of(history));
  CallerThread caller;
  return result_of(caller, py::none(), [&](const Progress&) {
    return study::check_against(request, caller.interrupt());
  });
}

py::list comparison_tables(const study::AgainstResult& result) {
  py::list tables;
  for (const auto& sheet : result.sheets) {
    record::SheetRows rows(sheet);
    tables.append(read_rows(rows));
  }
  return tables;
}

}  // namespace

void bind_study(py::module_& core) {
  core.def("verify", &verify, py::arg("methods"), py::arg("solvers"), py::arg("cases"),
           py::arg("expect"), py::arg("options"), py::arg("command"), py::arg("progress"));
  core.def("check", &check, py::arg("subjects"), py::arg("events"), py::arg("case"),
           py::arg("steps"), py::arg("tolerances"), py::arg("columns"), py::arg("expect"),
           py::arg("tolerance"), py::arg("results"), py::arg("command"), py::arg("progress"));
  py::class_<study::AgainstResult, std::shared_ptr<study::AgainstResult>>(core, "Comparison")
      .def_readonly("is_within", &study::AgainstResult::is_within)
      .def_property_readonly("tables", &comparison_tables);
  core.def("compare", &compare, py::arg("first"), py::arg("second"), py::arg("steps"),
           py::arg("tolerances"), py::arg("columns"), py::arg("tolerance"), py::arg("results"));
  core.def("tolerances_from", &solvers::tolerances_from, py::arg("text"));
  py::module_::import("atexit").attr("register")(py::cpp_function(&CallerThread::stop_all));
}

}  // namespace clackers::python
