#include "bindings/python/problem.hpp"

#include <fmt/format.h>

#include <optional>

#include "bindings/python/bind.hpp"
#include "clackers/base/error.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::python {
namespace {

std::size_t read_contact(std::string_view who, py::handle contact) {
  const auto number = read_whole(who, "contact", contact);
  if (number < 0)
    refuse(who, "contact", fmt::to_string(number), "a number from 0, as in Problem.contacts");
  return std::size_t(number);
}

py::tuple start_of(const Problem& problem) {
  const auto& start = problem->start;
  return py::make_tuple(start.t, read_only(start.u), read_only(start.v));
}

py::list contacts_of(const Problem& problem) {
  py::list rows;
  for (const auto& contact : problem->contacts)
    rows.append(py::make_tuple(read_only(contact.direction), contact.gap, contact.restitution));
  return rows;
}

py::list springs_of(const Problem& problem) {
  py::list rows;
  if (const auto* springs = model::one_sided_springs(*problem))
    for (std::size_t j = 0; j < springs->contacts().size(); ++j)
      rows.append(py::make_tuple(read_only(springs->contacts()[j].direction),
                                 springs->contacts()[j].gap, springs->stiffnesses()[j]));
  return rows;
}

}  // namespace

Doubles Problem::read_state(std::string_view who, py::handle y) const {
  auto state = read_array(who, "y", y);
  if (state.ndim() != 1 || std::size_t(state.size()) != equations_.size())
    refuse(who, "y", description(state),
           fmt::format("shape ({},), displacements then velocities", equations_.size()), {},
           "wrong-size");
  return state;
}

Doubles Problem::rhs(py::handle t, py::handle y) const {
  const auto state = read_state("rhs", y);
  Doubles rate(state.size());
  equations_.rate(read_number("rhs", "t", t), values_of(state), place_of(rate));
  return rate;
}

double Problem::gap(py::handle y, py::handle contact) const {
  return equations_.gap(values_of(read_state("gap", y)), read_contact("gap", contact));
}

Doubles Problem::impact(py::handle y, py::handle contact) const {
  const auto state = read_state("impact", y);
  Doubles after(state.size());
  const auto number =
      contact.is_none() ? std::nullopt : std::optional(read_contact("impact", contact));
  equations_.impact(values_of(state), number, place_of(after));
  return after;
}

Doubles Problem::load(py::handle t) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(problem_->dof());
  const double time = read_number("load", "t", t);
  const auto& add = problem_->system.add_load;
  if (add) add(time, {force.data(), std::size_t(force.size())});
  return read_only(force);
}

void bind_problem(py::module_& core) {
  const auto matrix = [](auto member) {
    return [member](const Problem& problem) { return read_only(problem->system.*member); };
  };
  using System = model::SmoothSystem<>;
  py::class_<Problem>(core, "Problem")
      .def_property_readonly("dof", [](const Problem& problem) { return problem->dof(); })
      .def_property_readonly("mass", matrix(&System::mass))
      .def_property_readonly("damping", matrix(&System::damping))
      .def_property_readonly("stiffness", matrix(&System::stiffness))
      .def_property_readonly("start", &start_of)
      .def_property_readonly("end", [](const Problem& problem) { return problem->end; })
      .def_property_readonly("contacts", &contacts_of)
      .def_property_readonly("springs", &springs_of)
      .def("load", &Problem::load, py::arg("t"))
      .def("rhs", &Problem::rhs, py::arg("t"), py::arg("y"))
      .def("gap", &Problem::gap, py::arg("y"), py::arg("contact"))
      .def("impact", &Problem::impact, py::arg("y"), py::arg("contact"));
}

}  // namespace clackers::python
