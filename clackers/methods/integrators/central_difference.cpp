#include "clackers/methods/integrators/central_difference.hpp"

#include "clackers/methods/rows.hpp"

namespace clackers::methods {

const std::vector<Field<CentralDifference>>& CentralDifference::fields() {
  static const std::vector<Field<CentralDifference>> none;
  return none;
}

Facts CentralDifference::facts() const {
  return {.name = specification(*this), .smooth_order = 2.0, .stability_limit = 2.0};
}

template Row row<CentralDifference>();

}  // namespace clackers::methods
