#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "clackers/model/system.hpp"

// The matrix T_1 of StepPowers, found by steps of an integrator. Apart from the stepper, which each
// integrator instantiates three times.
namespace clackers::methods {

/// The unknowns of a step, u and v of `dof` masses first, and what moves them by a step of h from t = 0.
struct UnknownsStep {
  std::vector<double>& unknowns;
  Eigen::Index dof;
  double h;
  std::function<void()> advance;
};

/// By steps from unit vectors.
Eigen::MatrixXd step_change(const UnknownsStep& step);

/// `system` with what u + e_j or v + e_j does as a load, of u for j = column and of v for
/// j = column - dof. `column` must outlive the result.
template <int Dof>
model::SmoothSystem<Dof> with_column_as_load(const model::SmoothSystem<Dof>& system,
                                             const Eigen::Index& column);

/// Steps from unit vectors lose what a step adds beside the 1 of their own. This finds it anew by steps
/// from 0 of the system with_column_as_load(), whose `column` it sets.
void improve_step_change(const UnknownsStep& step, Eigen::Index& column, Eigen::MatrixXd& change);

}  // namespace clackers::methods
