#include "clackers/methods/contact/reversal.hpp"

#include "clackers/methods/rows.hpp"

namespace clackers::methods {

const std::vector<Field<Reversal>>& Reversal::fields() {
  static const std::vector<Field<Reversal>> none;
  return none;
}

Claim Reversal::claim(const Facts&) const { return {Behaviour::irregular, 1.0, {}}; }

std::optional<Objection> Reversal::objection(const std::string& who,
                                             const model::ImpactProblem<>& problem) const {
  return objection_to_closed_contacts(who, problem);
}

template Row row<Reversal>();

}  // namespace clackers::methods
