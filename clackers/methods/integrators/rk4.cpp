#include "clackers/methods/integrators/rk4.hpp"

#include <numbers>

#include "clackers/methods/rows.hpp"

namespace clackers::methods {

const std::vector<ParameterOf<Rk4>>& Rk4::parameters() {
  static const std::vector<ParameterOf<Rk4>> none;
  return none;
}

IntegratorFacts Rk4::facts() const {
  return {spelled(*this), 4.0, false, 2.0 * std::numbers::sqrt2};
}

template IntegratorRow integrator_row<Rk4>();

}  // namespace clackers::methods
