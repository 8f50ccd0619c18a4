#include "clackers/model/motion.hpp"

namespace clackers::model {

Kinematics Motion::at(double t, Side side) const {
  const auto n = dof();
  Kinematics now{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  const auto size = static_cast<std::size_t>(n);
  sample({&t, 1}, side, {{now.u.data(), size}, {now.v.data(), size}, {now.a.data(), size}});
  return now;
}

}  // namespace clackers::model
