#include "clackers/methods/contact/impact_law.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "clackers/numerics/spd_solver.hpp"

namespace clackers::methods {

template <int Dof>
std::vector<ImpactLaw<Dof>> impact_laws(const model::ImpactProblem<Dof>& problem) {
  numerics::SpdSolver<Dof> mass;
  mass.compute(problem.system.mass);
  std::vector<ImpactLaw<Dof>> laws;
  for (const auto& contact : problem.contacts) {
    ImpactLaw<Dof> law{contact, contact.direction, 0.0};
    mass.solve_in_place(law.inverse_mass_direction);
    law.inverse_effective_mass = contact.direction.dot(law.inverse_mass_direction);
    laws.push_back(law);
  }
  return laws;
}

template <int Dof>
bool are_coupled(const ImpactLaw<Dof>& one, const ImpactLaw<Dof>& other) {
  // Orthogonal rows leave n products' rounding; any real coupling is far larger.
  const double size = std::sqrt(one.inverse_effective_mass * other.inverse_effective_mass);
  const double n = double(one.inverse_mass_direction.size());
  const double rounding = 16.0 * n * std::numeric_limits<double>::epsilon();
  return std::abs(one.contact.direction.dot(other.inverse_mass_direction)) > rounding * size;
}

std::string simultaneous(std::size_t one, std::size_t other) {
  return fmt::format(
      "contacts {} and {} share a mass and are closed together, which needs a complementarity "
      "solver",
      one + 1, other + 1);
}

std::optional<Objection> objection_to_closed_contacts(const std::string& who,
                                                      const model::ImpactProblem<>& problem) {
  const auto laws = impact_laws(problem);
  const auto is_closed = [&](const auto& law) {
    return law.contact.gap_at(problem.start.u) <= law.rounding(problem.start.u);
  };
  for (std::size_t i = 0; i < laws.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (is_closed(laws[i]) && is_closed(laws[j]) && are_coupled(laws[i], laws[j]))
        return Objection{fmt::format("{}: t = {} s: {}. Start with one of them open.", who,
                                     problem.start.t, simultaneous(j, i)),
                         "simultaneous-contacts"};
  return std::nullopt;
}

template std::vector<ImpactLaw<1>> impact_laws(const model::ImpactProblem<1>&);
template std::vector<ImpactLaw<2>> impact_laws(const model::ImpactProblem<2>&);
template std::vector<ImpactLaw<model::any_dof>> impact_laws(const model::ImpactProblem<>&);
template bool are_coupled(const ImpactLaw<1>&, const ImpactLaw<1>&);
template bool are_coupled(const ImpactLaw<2>&, const ImpactLaw<2>&);
template bool are_coupled(const ImpactLaw<model::any_dof>&, const ImpactLaw<model::any_dof>&);

}  // namespace clackers::methods
