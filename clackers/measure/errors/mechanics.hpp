#pragma once

#include <Eigen/Core>
#include <vector>

#include "clackers/model/impact_problem.hpp"

namespace clackers::measure {

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

/// Kinetic energy v' M v / 2 and potential energy u' K u / 2 of a linear structure [J].
class MechanicalEnergy {
 public:
  explicit MechanicalEnergy(const model::SmoothSystem<>& system);

  /// `v` [m/s] and `u` [m]: one entry a degree of freedom.
  double kinetic(const double* v) const { return 0.5 * form(mass_, v); }
  double potential(const double* u) const { return 0.5 * form(stiffness_, u); }
  double total(const double* u, const double* v) const { return kinetic(v) + potential(u); }

 private:
  // The entries of a matrix that are not zero, row by row.
  struct Rows {
    std::vector<std::size_t> ends, columns;
    std::vector<double> values;
  };
  static Rows rows_of(const Eigen::MatrixXd& matrix);

  // x' A x.
  static double form(const Rows& matrix, const double* x) {
    double sum = 0.0;
    std::size_t k = 0;
    for (std::size_t i = 0; i < matrix.ends.size(); ++i) {
      double row = 0.0;
      for (; k < matrix.ends[i]; ++k) row += matrix.values[k] * x[matrix.columns[k]];
      sum += x[i] * row;
    }
    return sum;
  }

  Rows mass_, stiffness_;
};

}  // namespace clackers::measure
