#include "clackers/methods/contact/reversal.hpp"

namespace clackers::methods {

const std::vector<ParameterOf<Reversal>>& Reversal::parameters() {
  static const std::vector<ParameterOf<Reversal>> none;
  return none;
}

Claim Reversal::claim(const IntegratorFacts&) const { return {Behaviour::irregular, 1.0, {}}; }

std::optional<Objection> Reversal::objection(const std::string& who,
                                             const model::ImpactProblem<>& problem) const {
  return objection_to_closed_contacts(who, problem);
}

}  // namespace clackers::methods
