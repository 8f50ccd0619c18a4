#include "clackers/exact/assembly/modal_shape.hpp"

#include <cmath>
#include <numbers>

namespace clackers::exact {

using numerics::DoubleDouble;

ModalShape::ModalShape(std::vector<ModalColumn> columns, const DoubleDouble& omega, double sigma)
    : columns_(std::move(columns)), sigma_(sigma) {
  for (const auto& column : columns_) frequencies_.push_back(omega * column.multiple);
}

model::Kinematics ModalShape::amplitude() const {
  const auto n = static_cast<Eigen::Index>(dof());
  model::Kinematics sum{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n),
                        Eigen::VectorXd::Zero(n)};
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    const bool has_partner =
        j + 1 < columns_.size() && columns_[j + 1].multiple == columns_[j].multiple;
    const double w = std::hypot(frequencies_[j].hi, sigma_);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto mass = static_cast<std::size_t>(i);
      const double other = has_partner ? columns_[j + 1].amplitude[mass] : 0.0;
      const double size = std::hypot(columns_[j].amplitude[mass], other);
      sum.u[i] += size;
      sum.v[i] += size * w;
      sum.a[i] += size * w * w;
    }
    if (has_partner) ++j;
  }
  return sum;
}

model::Kinematics ModalShape::error() const {
  const double units = std::numbers::sqrt2 * (static_cast<double>(columns_.size()) + 3.0) + 0.1;
  auto bound = amplitude();
  for (auto* x : {&bound.u, &bound.v, &bound.a}) *x *= units * 0x1p-53;
  return bound;
}

}  // namespace clackers::exact
