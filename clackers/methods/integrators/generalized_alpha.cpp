#include "clackers/methods/integrators/generalized_alpha.hpp"

#include <limits>

#include "clackers/base/error.hpp"
#include "clackers/methods/rows.hpp"

namespace clackers::methods {

const std::vector<Field<GeneralizedAlpha>>& GeneralizedAlpha::fields() {
  static const std::vector<Field<GeneralizedAlpha>> all = {
      {"rho", "0 <= rho <= 1", "spectral radius at infinite omega h; 1: no dissipation",
       &GeneralizedAlpha::rho}};
  return all;
}

void GeneralizedAlpha::validate() const {
  if (!(rho >= 0.0 && rho <= 1.0)) refuse(name, "rho", rho, "0 <= rho <= 1");
}

Facts GeneralizedAlpha::facts() const {
  return {.name = specification(*this),
          .smooth_order = 2.0,
          .stability_limit = std::numeric_limits<double>::infinity()};
}

template Row row<GeneralizedAlpha>();

}  // namespace clackers::methods
