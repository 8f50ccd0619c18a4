#include "clackers/exact/quantities/variation.hpp"

#include <fmt/format.h>

#include "clackers/exact/quantities/sensitivity.hpp"

namespace clackers::exact {

Eigen::MatrixXd first_variation(const ClosedForm& motion, double t, model::Side side) {
  const Eigen::Index n = motion.dof();
  Eigen::MatrixXd phi(2 * n, 2 * n);
  for (Eigen::Index column = 0; column < 2 * n; ++column) {
    const auto name = fmt::format("{}{}0", column < n ? 'u' : 'v', column % n + 1);
    const auto change = raw_sensitivity(motion, name)->at(t, side);
    phi.col(column) << change.u, change.v;
  }
  return phi;
}

}  // namespace clackers::exact
