#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <Eigen/Cholesky>
#include <limits>
#include <memory>
#include <optional>

#include "bindings/python/arguments.hpp"
#include "bindings/python/bind.hpp"
#include "bindings/python/problem.hpp"
#include "clackers/base/error.hpp"

namespace clackers::python {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using State = Eigen::Map<const VectorXd>;

}  // namespace

Problem::Problem(std::shared_ptr<const model::ImpactProblem<>> problem)
    : problem_(std::move(problem)), mass_(problem_->system.mass) {}

Doubles Problem::read_state(std::string_view who, py::handle y) const {
  auto state = read_array(who, "y", y);
  if (state.ndim() != 1 || state.size() != 2 * dof())
    refuse(who, "y", description(state),
           fmt::format("shape ({},), displacements then velocities", 2 * dof()), {}, "wrong-size");
  return state;
}

VectorXd Problem::load(double t) const {
  VectorXd force = VectorXd::Zero(dof());
  if (problem_->system.add_load)
    problem_->system.add_load(t, {force.data(), std::size_t(force.size())});
  return force;
}

Doubles Problem::rhs(double t, py::handle y) const {
  const auto state = read_state("rhs", y);
  const State u(state.data(), dof()), v(state.data() + dof(), dof());
  const auto& system = problem_->system;
  VectorXd force = load(t) - system.damping * v - system.stiffness * u;
  if (system.nonlinear) {
    VectorXd internal = VectorXd::Zero(dof());
    system.nonlinear->add(u, v, internal);
    force -= internal;
  }
  Doubles rate(state.size());
  Eigen::Map<VectorXd> out(rate.mutable_data(), rate.size());
  out.head(dof()) = v;
  out.tail(dof()) = mass_.solve(force);
  return rate;
}

double Problem::gap(py::handle y, std::size_t contact) const {
  const auto state = read_state("gap", y);
  return contact_at("gap", contact).gap_at(State(state.data(), dof()));
}

Doubles Problem::impact(py::handle y, std::optional<std::size_t> contact) const {
  const auto state = read_state("impact", y);
  const State u(state.data(), dof()), v(state.data() + dof(), dof());
  const auto& closed = contact ? contact_at("impact", *contact) : nearest_contact(u);
  const double rate = closed.gap_rate(v);
  if (rate > 0.0)
    refuse(
        "impact", "gap rate", rate, "gap rate <= 0 m/s, a contact that closes",
        "The contact opens in this state: its impact is already applied, or the event was found on "
        "the way out.");
  const VectorXd response = mass_.solve(closed.direction);
  Doubles after(state.size());
  Eigen::Map<VectorXd> out(after.mutable_data(), after.size());
  out.head(dof()) = u;
  out.tail(dof()) =
      v - (1.0 + closed.restitution) * rate / closed.direction.dot(response) * response;
  return after;
}

const model::Contact<>& Problem::contact_at(std::string_view who, std::size_t contact) const {
  const auto& contacts = problem_->contacts;
  if (contact >= contacts.size())
    refuse(who, "contact", double(contact),
           fmt::format("0 <= contact < {}, the contacts of this problem", contacts.size()));
  return contacts[contact];
}

const model::Contact<>& Problem::nearest_contact(const VectorXd& u) const {
  const model::Contact<>* nearest = nullptr;
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& contact : problem_->contacts)
    if (const double gap = std::abs(contact.gap_at(u)); !(gap >= smallest)) {
      nearest = &contact;
      smallest = gap;
    }
  if (nearest == nullptr) throw InputError("impact: this problem has no contact.", "out-of-range");
  return *nearest;
}

void bind_problem(py::module_& core) {
  py::class_<Problem>(core, "Problem")
      .def_property_readonly("dof", &Problem::dof)
      .def_property_readonly("mass", [](const Problem& p) { return read_only(p->system.mass); })
      .def_property_readonly("damping",
                             [](const Problem& p) { return read_only(p->system.damping); })
      .def_property_readonly("stiffness",
                             [](const Problem& p) { return read_only(p->system.stiffness); })
      .def_property_readonly("start",
                             [](const Problem& p) {
                               return py::make_tuple(p->start.t, read_only(p->start.u),
                                                     read_only(p->start.v));
                             })
      .def_property_readonly("end", [](const Problem& p) { return p->end; })
      .def_property_readonly(
          "contacts",
          [](const Problem& p) {
            py::list rows;
            for (const auto& c : p->contacts)
              rows.append(py::make_tuple(read_only(c.direction), c.gap, c.restitution));
            return rows;
          })
      .def(
          "load", [](const Problem& p, double t) { return read_only(p.load(t)); }, py::arg("t"))
      .def("rhs", &Problem::rhs, py::arg("t"), py::arg("y"))
      .def("gap", &Problem::gap, py::arg("y"), py::arg("contact"))
      .def("impact", &Problem::impact, py::arg("y"), py::arg("contact"));
}

}  // namespace clackers::python
