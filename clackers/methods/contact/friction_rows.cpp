#include "clackers/methods/contact/friction_rows.hpp"

#include <fmt/format.h>

namespace clackers::methods {

std::optional<Objection> objection_to_friction_with_contacts(
    const std::string& who, const model::ImpactProblem<>& problem) {
  if (problem.frictions.empty() || problem.contacts.empty()) return std::nullopt;
  return Objection{
      who +
          ": the problem has friction and contacts, but friction is taken of a constant "
          "normal force only. Leave out one of both.",
      "linear-only"};
}

std::optional<Objection> objection_to_stick_slip(const std::string& who,
                                                 const model::ImpactProblem<>& problem) {
  const ContactSet<model::any_dof> rows = friction_rows(problem);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (rows.are_coupled(i, j))
        return Objection{
            fmt::format("{}: rows {} and {} of friction share a mass; allowed: rows that "
                        "do not. Use moreau-jean.",
                        who, j + 1, i + 1),
            "linear-only"};
  return objection_to_friction_with_contacts(who, problem);
}

}  // namespace clackers::methods
