#pragma once

#include <Eigen/Core>
#include <vector>

#include "clackers/base/constants.hpp"

namespace clackers::numerics {

/// What rounding leaves in the entries of a matrix that is seen through modes.
inline double rounding_of(const Eigen::MatrixXd& x) {
  return 64.0 * double(x.rows()) * epsilon * x.cwiseAbs().maxCoeff();
}

/// Of the coordinates of two such matrices those that an entry above rounding of either connects.
std::vector<std::vector<Eigen::Index>> coupled_blocks(const Eigen::MatrixXd& a,
                                                      const Eigen::MatrixXd& b);

}  // namespace clackers::numerics
