#include "clackers/methods/integrators/newmark.hpp"

#include <cmath>
#include <limits>

#include "clackers/base/error.hpp"
#include "clackers/methods/rows.hpp"

namespace clackers::methods {

const std::vector<Field<Newmark>>& Newmark::fields() {
  static const std::vector<Field<Newmark>> all = {
      {"beta", "0 <= beta <= 1/2", "weight of the new acceleration in u", &Newmark::beta},
      {"gamma", "1/2 <= gamma <= 1", "weight of the new acceleration in v", &Newmark::gamma}};
  return all;
}

void Newmark::validate() const {
  if (!(beta >= 0.0 && beta <= 0.5)) refuse(name, "beta", beta, "0 <= beta <= 1/2");
  if (!(gamma >= 0.5 && gamma <= 1.0))
    refuse(name, "gamma", gamma, "1/2 <= gamma <= 1",
           "Below 1/2 undamped motion grows at every step size; use gamma = 0.5 for no numerical "
           "dissipation.");
}

Facts Newmark::facts() const {
  const bool stable = 2.0 * beta >= gamma;
  return {.name = specification(*this),
          .smooth_order = gamma == 0.5 ? 2.0 : 1.0,
          .stability_limit = stable ? std::numeric_limits<double>::infinity()
                                    : 1.0 / std::sqrt(0.5 * gamma - beta)};
}

template Row row<Newmark>();

}  // namespace clackers::methods
