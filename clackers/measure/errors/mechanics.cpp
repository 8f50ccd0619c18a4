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

// In fixed sizes a step takes no memory.
template <int Dof>
model::Vector<Dof> FreeMotion::acceleration_of(double t, const model::Vector<Dof>& u,
                                               const model::Vector<Dof>& v) const {
  const auto fixed = [](const Eigen::MatrixXd& x) {
    return Eigen::Map<const model::Matrix<Dof>>(x.data(), x.rows(), x.cols());
  };
  model::Vector<Dof> force = -(fixed(system_.damping) * v) - fixed(system_.stiffness) * u;
  if (system_.add_load) system_.add_load(t, {force.data(), std::size_t(force.size())});
  if (system_.nonlinear) {
    Eigen::VectorXd internal = Eigen::VectorXd::Zero(force.size());
    system_.nonlinear->add(u, v, internal);
    force -= internal;
  }
  return fixed(inverse_mass_) * force;
}

template <int Dof>
FreeState FreeMotion::moved_by(const FreeState& from, double s, int steps) const {
  using Vector = model::Vector<Dof>;
  const double h = s / steps, half = 0.5 * h;
  double t = from.t;
  Vector u = from.u, v = from.v;
  for (int step = 0; step < steps; ++step, t += h) {
    const Vector a1 = acceleration_of<Dof>(t, u, v);
    const Vector v2 = v + half * a1;
    const Vector a2 = acceleration_of<Dof>(t + half, u + half * v, v2);
    const Vector v3 = v + half * a2;
    const Vector a3 = acceleration_of<Dof>(t + half, u + half * v2, v3);
    const Vector v4 = v + h * a3;
    const Vector a4 = acceleration_of<Dof>(t + h, u + h * v3, v4);
    u += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
    v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
  return {t, u, v};
}

Eigen::VectorXd FreeMotion::acceleration(double t, const Eigen::VectorXd& u,
                                         const Eigen::VectorXd& v) const {
  return acceleration_of<model::any_dof>(t, u, v);
}

FreeState FreeMotion::moved(const FreeState& from, double s, int steps) const {
  switch (from.u.size()) {
    case 1:
      return moved_by<1>(from, s, steps);
    case 2:
      return moved_by<2>(from, s, steps);
    default:
      return moved_by<model::any_dof>(from, s, steps);
  }
}

MechanicalEnergy::MechanicalEnergy(const model::SmoothSystem<>& system)
    : mass_(rows_of(system.mass)),
      stiffness_(rows_of(system.stiffness)),
      dof_(system.dof()),
      nonlinear_(system.nonlinear) {}

}  // namespace clackers::measure
