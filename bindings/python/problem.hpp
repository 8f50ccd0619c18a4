#pragma once

#include <pybind11/pybind11.h>

#include <Eigen/Cholesky>
#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>

#include "bindings/python/arguments.hpp"
#include "clackers/model/impact_problem.hpp"

namespace clackers::python {

/// A problem as first-order equations for y = (u, v), the form that solvers in Python take.
class Problem {
 public:
  explicit Problem(std::shared_ptr<const model::ImpactProblem<>> problem);

  const model::ImpactProblem<>* operator->() const { return problem_.get(); }
  Eigen::Index dof() const { return problem_->dof(); }

  /// f(t) [N].
  Eigen::VectorXd load(double t) const;
  /// dy/dt = (v, M^-1 (f - C v - K u - p)) while nothing collides.
  Doubles rhs(double t, py::handle y) const;
  /// g = b . u - gap of a contact [m].
  double gap(py::handle y, std::size_t contact) const;
  /// y after Newton's law at a contact, v(+) = v(-) - (1 + eta) (b . v(-)) / (b . M^-1 b) M^-1 b; without
  /// a contact given, at the one whose gap is nearest to 0. Throws InputError where it opens.
  Doubles impact(py::handle y, std::optional<std::size_t> contact) const;

 private:
  Doubles read_state(std::string_view who, py::handle y) const;
  const model::Contact<>& contact_at(std::string_view who, std::size_t contact) const;
  const model::Contact<>& nearest_contact(const Eigen::VectorXd& u) const;

  std::shared_ptr<const model::ImpactProblem<>> problem_;
  Eigen::LLT<Eigen::MatrixXd> mass_;
};

}  // namespace clackers::python
