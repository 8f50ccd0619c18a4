#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/methods/contact/contact_set.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"

namespace clackers::methods {

/// Impacts located inside the step. Contacts j with gaps g_j and Newton's law,
///
///     g_j = b_j . u - gap_j >= 0,   M [v(+) - v(-)] = sum_j b_j P_j,
///     0 <= b_j . v(+) + eta_j b_j . v(-) _|_ P_j >= 0
///
/// have an impact where the step map crosses g_j = 0 from above with b_j . v < 0; the state there
/// is that of the integrator's partial step. All contacts that are closed there, within rounding,
/// and do not separate take part in it at once, so nothing depends on their numbers. A neighbour
/// that touches at rest takes its part of the momentum, and so do neighbours that close so soon after
/// that the errors of the run so far cannot tell the instants apart (impact_resolution.hpp). The
/// integrator is restarted from v(+) and
/// completes the rest of the step, so output stays on the grid. Crossings are looked for whenever
/// the cubic through gap and gap rate at both ends of the step does not stay open, also when both
/// ends are. A crossing with b_j . v >= 0 is grazing: the integrator is restarted there without an
/// impulse. A step of an adaptive integrator ends at the event, located on the dense output; the state
/// there is in the report of the impact alone.
///
/// Contacts that are closed with gap rate 0, after an impact with eta = 0 or from a start at rest,
/// are active constraints where their accelerations A and forces F say so: 0 <= A _|_ F >= 0,
/// solved for all of them. A contact is let go where its force changes sign. Contacts that are
/// closed at once with linearly dependent b_j end the run, and so do more than 1000 events in one
/// step.
///
/// Order       that of the integrator.
/// Stability   that of the integrator.
/// Dissipation none at impacts with eta = 1.
/// Memory      what the integrator remembers is dropped at each impact.
/// Cost        two products a contact and step; about ten partial steps an impact, seventy more where
///             contacts that share a mass close in one step.
/// Source      L. F. Shampine, I. Gladwell, R. W. Brankin, ACM Trans. Math. Softw. 17, 11-25
/// (1991).
struct EventDriven {
  static constexpr std::string_view name = "event-driven";
  static constexpr std::string_view summary =
      "impacts located inside the step, the rest of the step completed after them";

  static constexpr int most_events = 1000;  ///< in one step; a message and the card repeat it

  Claim claim(const Facts& integrator) const {
    return {Behaviour::proper, integrator.smooth_order, {}};
  }
  std::optional<Objection> objection(const Facts& method,
                                     const model::ImpactProblem<>& problem) const {
    return objection_to_closed_contacts(method.name, problem);
  }
  double contact_time(const model::ImpactProblem<>&) const { return 0.0; }

  template <int Dof>
  class Loop;
};

}  // namespace clackers::methods
