#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "clackers/methods/method.hpp"
#include "clackers/model/impact_problem.hpp"

namespace clackers::methods {

/// Newton's law of restitution at one contact, with what it needs of the mass matrix.
template <int Dof>
struct ImpactLaw {
  using Vector = model::Vector<Dof>;

  model::Contact<Dof> contact;
  Vector inverse_mass_direction;  ///< M^-1 b: the velocity that a unit impulse along b gives [1/kg]
  double inverse_effective_mass = 0.0;  ///< b . M^-1 b [1/kg]

  /// Turns the velocity before an impact into the one after it. Returns the impulse along b [N s].
  double apply(Vector& v) const {
    const double impulse =
        -(1.0 + contact.restitution) * contact.gap_rate(v) / inverse_effective_mass;
    v += impulse * inverse_mass_direction;
    return impulse;
  }

  /// How far from 0 the gap can be by rounding alone [m]: n products and the gap, and as much
  /// again for u itself being rounded, twice.
  double rounding(const Vector& u) const {
    const double terms = contact.direction.cwiseAbs().dot(u.cwiseAbs()) + std::abs(contact.gap);
    return 8.0 * std::numeric_limits<double>::epsilon() * terms;
  }
};

template <int Dof>
std::vector<ImpactLaw<Dof>> impact_laws(const model::ImpactProblem<Dof>& problem);

/// True where an impulse at one contact changes the gap rate at the other.
template <int Dof>
bool are_coupled(const ImpactLaw<Dof>& one, const ImpactLaw<Dof>& other);

/// The objection of treatments without a complementarity solver to a problem that starts with two
/// coupled contacts closed; or nothing.
std::optional<Objection> objection_to_closed_contacts(const std::string& who,
                                                      const model::ImpactProblem<>& problem);

/// What the same treatments say when it happens during a run.
std::string simultaneous(std::size_t one, std::size_t other);

}  // namespace clackers::methods
