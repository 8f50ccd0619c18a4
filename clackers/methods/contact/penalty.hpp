#pragma once

#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"

namespace clackers::methods {

/// A linear one-sided spring in place of each contact, in the integrator's own equilibrium:
///
///     M a + C v + K u + p(u) = f(t),   p = sum_j stiffness_j min(g_j, 0) b_j,   g_j = b_j . u -
///     gap_j
///
/// solved by Newton's iteration where the integrator is implicit in u. A contact lasts
/// pi sqrt(m_e / stiffness), m_e = 1 / (b . M^-1 b). It is elastic and models
/// eta = 1 alone. An impact is reported at the first touch of each contact, located on the step
/// map, with equal velocities before and after and no impulse: the force acts later, over the
/// contact time. The default stiffness of a contact is 1e4 times the diagonal stiffness of the
/// first degree of freedom in its row, or more: so much that a contact lasts at most a fortieth of
/// the shortest period of a mass in its row, alone on its springs. A softer contact lets the fast
/// mass bounce where the true masses do not collide.
///
/// Order       none: the error comes to stand at the contact time, of order stiffness^(-1/2).
/// Stability   that of the integrator with the stiffness of the closed contact.
/// Dissipation that of the integrator; energy is created or lost where a contact lasts few steps.
/// Memory      that of the integrator.
/// Cost        one to three factorizations a step.
/// Source      P. Wriggers, Computational Contact Mechanics, 2nd ed., Springer (2006).
struct Penalty {
  static constexpr std::string_view name = "penalty";
  static constexpr std::string_view summary =
      "a linear one-sided spring in place of each contact, as in finite-element codes";
  static const std::vector<Field<Penalty>>& fields();

  /// [N/m], > 0; NaN: the default above.
  double stiffness = std::numeric_limits<double>::quiet_NaN();

  /// Throws InputError unless 0 < stiffness < infinity, or NaN.
  void validate() const;
  Claim claim(const Facts& integrator) const;
  /// To those of linear motion alone.
  std::optional<Objection> objection_to(const Facts& method) const;
  std::optional<Objection> objection(const Facts& method,
                                     const model::ImpactProblem<>& problem) const;
  /// The shortest of the contacts' [s]; 0 without contacts.
  double contact_time(const model::ImpactProblem<>& problem) const;
  /// Of each contact [N/m].
  template <int Dof>
  std::vector<double> stiffnesses(const model::ImpactProblem<Dof>& problem) const;

  template <int Dof>
  class Loop;
};

/// The problem with springs in its system; the contacts stay to be looked at.
template <int Dof>
model::ImpactProblem<Dof> with_springs(model::ImpactProblem<Dof> problem,
                                       std::vector<double> stiffnesses);

}  // namespace clackers::methods
