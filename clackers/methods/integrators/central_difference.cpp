#include "clackers/methods/integrators/central_difference.hpp"

#include "clackers/methods/rows.hpp"

namespace clackers::methods {

const std::vector<ParameterOf<CentralDifference>>& CentralDifference::parameters() {
  static const std::vector<ParameterOf<CentralDifference>> none;
  return none;
}

IntegratorFacts CentralDifference::facts() const { return {spelled(*this), 2.0, false, 2.0}; }

template IntegratorRow integrator_row<CentralDifference>();

}  // namespace clackers::methods
