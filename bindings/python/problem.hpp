#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string_view>

#include "bindings/python/arguments.hpp"
#include "clackers/model/first_order.hpp"

namespace clackers::python {

/// A problem as Python holds it, with its equations for y = (u, v).
class Problem {
 public:
  explicit Problem(std::shared_ptr<const model::ImpactProblem<>> problem)
      : problem_(std::move(problem)), equations_(*problem_) {}

  const model::ImpactProblem<>& operator*() const { return *problem_; }
  const model::ImpactProblem<>* operator->() const { return problem_.get(); }

  /// See model::FirstOrder. All throw InputError unless y has the shape (2 dof,).
  Doubles rhs(py::handle t, py::handle y) const;
  double gap(py::handle y, py::handle contact) const;
  Doubles impact(py::handle y, py::handle contact) const;  ///< None: the nearest contact
  /// f(t) [N].
  Doubles load(py::handle t) const;

 private:
  Doubles read_state(std::string_view who, py::handle y) const;

  std::shared_ptr<const model::ImpactProblem<>> problem_;
  model::FirstOrder equations_;
};

}  // namespace clackers::python
