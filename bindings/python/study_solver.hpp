#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/python/caller_thread.hpp"
#include "clackers/solvers/solver.hpp"

namespace clackers::python {

/// A callable under test as clackers._solver gives it.
struct CallableSubject {
  std::string name;
  /// Called with (_core.Problem, step or tolerance); returns (columns, events or None) as
  /// columns_of() reads them, or (has_returned, sentence, printed, would_repeat) of a failed run.
  py::object run;
  std::optional<Claim> expect;
  std::vector<double> steps, tolerances;
};

/// The callable as study::verify takes solvers. Its runs are calls in the thread of `caller`; both must
/// outlive the study.
solvers::SolverSubject solver_subject(const CallableSubject& callable, CallerThread& caller);

}  // namespace clackers::python
