#include "clackers/assess/metrics/penetration.hpp"

#include <algorithm>

#include "clackers/assess/metrics/value.hpp"

namespace clackers::assess {

MetricValue penetration(const Comparison& comparison) {
  if (comparison.problem().contacts.empty()) return not_measured("The problem has no contact.");
  const auto& u = comparison.history().u;
  const auto dof = comparison.dof();
  double deepest = 0.0;
  for (const auto& contact : comparison.problem().contacts)
    for (std::size_t i = 0; i < u.size(); i += dof) {
      double opening = -contact.gap;
      for (std::size_t j = 0; j < dof; ++j)
        opening += contact.direction[Eigen::Index(j)] * u[i + j];
      deepest = std::max(deepest, -opening);
    }
  return measured(deepest);
}

}  // namespace clackers::assess
