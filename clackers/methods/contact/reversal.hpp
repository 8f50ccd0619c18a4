#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"

namespace clackers::methods {

/// Velocities reversed at the end of the step, as a code does that looks at a contact only there:
/// where a step ends with
///
///     g = b . u1 - gap < 0 and b . v1 < 0,
///
/// Newton's law changes the velocity: M [v1(+) - v1(-)] = sum_j b_j P_j with
///
///     0 <= b_j . v1(+) + eta_j b_j . v1(-) _|_ P_j >= 0
///
/// for all contacts j that are closed or violated there and do not separate. The penetration stays
/// as it is. Contacts with linearly dependent b_j in one step end the run.
///
/// Order       1 of the upper envelope whatever the integrator's; errors of neighbouring steps
///             scatter.
/// Stability   that of the integrator.
/// Dissipation none in kinetic energy with eta = 1; the energy of the penetration is wrong at
///             random.
/// Memory      what the integrator remembers is dropped at each impact.
/// Cost        two products a contact and step.
/// Source      common practice; the order is the position of the impact in its step, known to h.
struct Reversal {
  static constexpr std::string_view name = "reversal";
  static constexpr std::string_view summary =
      "velocities reversed at the end of the step in which a contact is penetrated";

  Claim claim(const Facts& integrator) const;
  /// To adaptive ones.
  std::optional<Objection> objection_to(const Facts& method) const;
  std::optional<Objection> objection(const Facts& method,
                                     const model::ImpactProblem<>& problem) const;
  double contact_time(const model::ImpactProblem<>&) const { return 0.0; }

  template <int Dof>
  class Loop;
};

}  // namespace clackers::methods
