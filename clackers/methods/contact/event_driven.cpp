#include "clackers/methods/contact/event_driven.hpp"

#include "clackers/methods/contact/impact_law.hpp"

namespace clackers::methods {

const std::vector<ParameterOf<EventDriven>>& EventDriven::parameters() {
  static const std::vector<ParameterOf<EventDriven>> none;
  return none;
}

Claim EventDriven::claim(const IntegratorFacts& integrator) const {
  return {Behaviour::proper, integrator.order, {}};
}

std::optional<Objection> EventDriven::objection(const std::string& who,
                                                const model::ImpactProblem<>& problem) const {
  return objection_to_closed_contacts(who, problem);
}

}  // namespace clackers::methods
