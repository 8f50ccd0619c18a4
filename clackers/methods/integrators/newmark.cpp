#include "clackers/methods/integrators/newmark.hpp"

#include <cmath>
#include <limits>

#include "clackers/base/error.hpp"
#include "clackers/methods/rows.hpp"

namespace clackers::methods {

const std::vector<ParameterOf<Newmark>>& Newmark::parameters() {
  static const std::vector<ParameterOf<Newmark>> all = {
      member_parameter<&Newmark::beta, Newmark>("beta", "0 <= beta <= 1/2",
                                                "weight of the new acceleration in u"),
      member_parameter<&Newmark::gamma, Newmark>("gamma", "1/2 <= gamma <= 1",
                                                 "weight of the new acceleration in v")};
  return all;
}

void Newmark::validate() const {
  if (!(beta >= 0.0 && beta <= 0.5)) refuse(name, "beta", beta, "0 <= beta <= 1/2");
  if (!(gamma >= 0.5 && gamma <= 1.0))
    refuse(name, "gamma", gamma, "1/2 <= gamma <= 1",
           "Below 1/2 undamped motion grows at every step size; use gamma = 0.5 for no numerical "
           "dissipation.");
}

IntegratorFacts Newmark::facts() const {
  const bool stable = 2.0 * beta >= gamma;
  return {spelled(*this), gamma == 0.5 ? 2.0 : 1.0, stable,
          stable ? std::numeric_limits<double>::infinity() : 1.0 / std::sqrt(0.5 * gamma - beta)};
}

template IntegratorRow integrator_row<Newmark>();

}  // namespace clackers::methods
