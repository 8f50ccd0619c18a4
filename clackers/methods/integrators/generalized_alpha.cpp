#include "clackers/methods/integrators/generalized_alpha.hpp"

#include <limits>

#include "clackers/base/error.hpp"
#include "clackers/methods/rows.hpp"

namespace clackers::methods {

const std::vector<ParameterOf<GeneralizedAlpha>>& GeneralizedAlpha::parameters() {
  static const std::vector<ParameterOf<GeneralizedAlpha>> all = {
      member_parameter<&GeneralizedAlpha::rho, GeneralizedAlpha>(
          "rho", "0 <= rho <= 1", "spectral radius at infinite omega h; 1: no dissipation")};
  return all;
}

void GeneralizedAlpha::validate() const {
  if (!(rho >= 0.0 && rho <= 1.0)) refuse(name, "rho", rho, "0 <= rho <= 1");
}

IntegratorFacts GeneralizedAlpha::facts() const {
  return {spelled(*this), 2.0, true, std::numeric_limits<double>::infinity()};
}

template IntegratorRow integrator_row<GeneralizedAlpha>();

}  // namespace clackers::methods
