#pragma once

#include <Eigen/Core>

#include "clackers/model/impact_problem.hpp"

namespace clackers::assess {

using FreeState = model::State<model::any_dof>;

/// How a structure moves while nothing collides, from its equation of motion alone.
class FreeMotion {
 public:
  /// The system must outlive this; its mass matrix is positive definite.
  explicit FreeMotion(const model::SmoothSystem<>& system);
  explicit FreeMotion(model::SmoothSystem<>&&) = delete;

  /// M^-1 (f(t) - C v - K u - p(u, v)) [m/s^2].
  Eigen::VectorXd acceleration(double t, const Eigen::VectorXd& u, const Eigen::VectorXd& v) const;
  /// The state s [s] later, or earlier where s < 0: one step of the classical Runge-Kutta method of
  /// fourth order, local error O(s^5).
  FreeState moved(const FreeState& from, double s) const;
  /// M^-1 b: the velocity that a unit impulse along b gives.
  Eigen::VectorXd response(const Eigen::VectorXd& b) const { return inverse_mass_ * b; }

  const model::SmoothSystem<>& system() const { return system_; }

 private:
  const model::SmoothSystem<>& system_;
  Eigen::MatrixXd inverse_mass_;
};

}  // namespace clackers::assess
