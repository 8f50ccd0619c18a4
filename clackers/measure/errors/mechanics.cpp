#include "clackers/measure/errors/mechanics.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::measure {
MechanicalEnergy::Rows MechanicalEnergy::rows_of(const Eigen::MatrixXd& matrix) {
  Rows rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      if (matrix(i, j) != 0.0) {
        rows.columns.push_back(std::size_t(j));
        rows.values.push_back(matrix(i, j));
      }
    rows.ends.push_back(rows.values.size());
  }
  return rows;
}

FreeState row_state(const model::Trajectory& rows, std::size_t i) {
  const auto dof = Eigen::Index(rows.dof), at = Eigen::Index(i) * dof;
  return {rows.t[i], Eigen::Map<const Eigen::VectorXd>(rows.u.data() + at, dof),
          Eigen::Map<const Eigen::VectorXd>(rows.v.data() + at, dof)};
}

double highest_frequency(const model::SmoothSystem<>& system) {
  return std::sqrt(std::max(1e-6, numerics::highest_square(system.stiffness, system.mass)));
}

FreeMotion::FreeMotion(const model::SmoothSystem<>& system)
    : system_(system),
      inverse_mass_(
          numerics::solved(system.mass, Eigen::MatrixXd::Identity(system.dof(), system.dof()))) {}

Eigen::VectorXd FreeMotion::acceleration(double t, const Eigen::VectorXd& u,
                                         const Eigen::VectorXd& v) const {
  Eigen::VectorXd force = -(system_.damping * v) - system_.stiffness * u;
  if (system_.add_load) system_.add_load(t, {force.data(), std::size_t(force.size())});
  if (system_.nonlinear) {
    Eigen::VectorXd internal = Eigen::VectorXd::Zero(force.size());
    system_.nonlinear->add(u, v, internal);
    force -= internal;
  }
  return inverse_mass_ * force;
}

FreeState FreeMotion::moved(const FreeState& from, double s) const {
  const auto& [t, u, v] = from;
  const double half = 0.5 * s;
  const Eigen::VectorXd a1 = acceleration(t, u, v);
  const Eigen::VectorXd v2 = v + half * a1;
  const Eigen::VectorXd a2 = acceleration(t + half, u + half * v, v2);
  const Eigen::VectorXd v3 = v + half * a2;
  const Eigen::VectorXd a3 = acceleration(t + half, u + half * v2, v3);
  const Eigen::VectorXd v4 = v + s * a3;
  const Eigen::VectorXd a4 = acceleration(t + s, u + s * v3, v4);
  return {t + s, u + s / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4),
          v + s / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)};
}

MechanicalEnergy::MechanicalEnergy(const model::SmoothSystem<>& system)
    : mass_(rows_of(system.mass)), stiffness_(rows_of(system.stiffness)) {}

}  // namespace clackers::measure
