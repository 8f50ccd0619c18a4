#include "clackers/assess/metrics/momentum_error.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/assess/metrics/value.hpp"

namespace clackers::assess {

MetricValue momentum_error(const Comparison& comparison) {
  if (!comparison.has_velocities()) return not_measured("The history has no velocities.");
  const auto& mass = comparison.problem().system.mass;
  const Eigen::VectorXd columns = mass.colwise().sum();
  const auto dof = comparison.dof();
  double scale = 0.0;
  for (std::size_t j = 0; j < dof; ++j)
    scale += mass.col(Eigen::Index(j)).cwiseAbs().sum() * comparison.v_envelope()[j];
  if (!(scale > 0.0))
    return not_measured(
        "The true velocities have no extent at t = 0, so nothing is relative to them.");

  const auto& v = comparison.history().v;
  const auto v_true = comparison.true_v();
  double worst = 0.0;
  for (std::size_t i = 0; i < v.size(); i += dof) {
    double error = 0.0;
    for (std::size_t j = 0; j < dof; ++j)
      error += columns[Eigen::Index(j)] * (v[i + j] - v_true[i + j]);
    worst = std::max(worst, std::abs(error));
  }
  return measured(worst / scale);
}

}  // namespace clackers::assess
