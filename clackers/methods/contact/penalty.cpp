#include "clackers/methods/contact/penalty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/base/check.hpp"
#include "clackers/methods/rows.hpp"

namespace clackers::methods {
namespace {

constexpr double default_factor = 1e4;

// The degree of freedom whose stiffness sets the default of a contact.
template <int Dof>
Eigen::Index first_touched(const model::Contact<Dof>& contact) {
  Eigen::Index i = 0;
  while (contact.direction[i] == 0.0) ++i;
  return i;
}

}  // namespace

const std::vector<Field<Penalty>>& Penalty::fields() {
  static const std::vector<Field<Penalty>> all = {{"stiffness", "0 < stiffness < infinity",
                                                   "of the contact spring [N/m]",
                                                   &Penalty::stiffness, "1e4 k1"}};
  return all;
}

void Penalty::validate() const {
  if (!std::isnan(stiffness)) require_positive(name, "stiffness", stiffness);
}

Claim Penalty::claim(const Facts&) const {
  return {Behaviour::stagnating, 0.0, "contact-stiffness"};
}

template <int Dof>
std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<Dof>& problem) const {
  std::vector<double> all;
  for (const auto& contact : problem.contacts) {
    const auto i = first_touched(contact);
    all.push_back(std::isnan(stiffness) ? default_factor * problem.system.stiffness(i, i)
                                        : stiffness);
  }
  return all;
}

std::optional<Objection> Penalty::objection(const std::string& who,
                                            const model::ImpactProblem<>& problem) const {
  for (const auto& contact : problem.contacts) {
    if (contact.restitution != 1.0)
      return Objection{
          fmt::format("{} with eta = {}: a linear penalty spring gives back what it takes, "
                      "so it can only stand for eta = 1. Use event-driven.",
                      who, contact.restitution),
          "penalty-needs-elastic"};
  }
  const auto all = stiffnesses(problem);
  for (std::size_t j = 0; j < all.size(); ++j)
    if (!(all[j] > 0.0))
      return Objection{
          fmt::format("{}: contact {} has no default stiffness, since degree of freedom {}, "
                      "the first in its row, has none of its own. Give one: "
                      "penalty:stiffness=VALUE, in N/m.",
                      who, j + 1, first_touched(problem.contacts[j]) + 1),
          "no-default-stiffness"};
  return std::nullopt;
}

double Penalty::contact_time(const model::ImpactProblem<>& problem) const {
  const auto laws = impact_laws(problem);
  const auto all = stiffnesses(problem);
  double shortest = 0.0;
  for (std::size_t j = 0; j < laws.size(); ++j) {
    const double time = std::numbers::pi / std::sqrt(all[j] * laws[j].inverse_effective_mass);
    shortest = j == 0 ? time : std::min(shortest, time);
  }
  return shortest;
}

template std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<1>&) const;
template std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<2>&) const;
template std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<>&) const;

template Row row<Penalty>();

}  // namespace clackers::methods
