#pragma once

#include <Eigen/Core>

#include "clackers/base/constants.hpp"

namespace clackers::numerics {

/// What rounding leaves in the entries of a matrix that is seen through modes.
inline double rounding_of(const Eigen::MatrixXd& x) {
  return 64.0 * double(x.rows()) * epsilon * x.cwiseAbs().maxCoeff();
}

}  // namespace clackers::numerics
