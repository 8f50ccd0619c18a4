#include "clackers/methods/integrators/rk4.hpp"

#include <numbers>

#include "clackers/methods/rows.hpp"

namespace clackers::methods {

const std::vector<Field<Rk4>>& Rk4::fields() {
  static const std::vector<Field<Rk4>> none;
  return none;
}

Facts Rk4::facts() const {
  return {.name = specification(*this),
          .smooth_order = 4.0,
          .stability_limit = 2.0 * std::numbers::sqrt2};
}

template Row row<Rk4>();

}  // namespace clackers::methods
