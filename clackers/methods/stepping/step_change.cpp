#include "clackers/methods/stepping/step_change.hpp"

#include <algorithm>
#include <span>

namespace clackers::methods {
namespace {

Eigen::VectorXd end_of_step(const UnknownsStep& step, const Eigen::VectorXd& start) {
  std::copy_n(start.data(), start.size(), step.unknowns.begin());
  step.advance();
  return Eigen::VectorXd::Map(step.unknowns.data(), start.size());
}

}  // namespace

Eigen::MatrixXd step_change(const UnknownsStep& step) {
  const auto size = std::ssize(step.unknowns);
  Eigen::MatrixXd change(size, size);
  for (Eigen::Index j = 0; j < size; ++j)
    change.col(j) = end_of_step(step, Eigen::VectorXd::Unit(size, j));
  change.diagonal().head(2 * step.dof).array() -= 1.0;
  return change;
}

// u + e_j moves under -K e_j as u, and v + e_j, u + t e_j under -(C + t K) e_j.
template <int Dof>
model::SmoothSystem<Dof> with_column_as_load(const model::SmoothSystem<Dof>& system,
                                             const Eigen::Index& column) {
  auto loaded = system;
  loaded.add_load = [&system, &column](double t, std::span<double> force) {
    const auto n = system.dof(), j = column % n;
    Eigen::Map<Eigen::VectorXd> f(force.data(), n);
    if (column < n)
      f -= system.stiffness.col(j);
    else
      f -= system.damping.col(j) + t * system.stiffness.col(j);
  };
  return loaded;
}

void improve_step_change(const UnknownsStep& step, Eigen::Index& column, Eigen::MatrixXd& change) {
  const auto n = step.dof;
  for (column = 0; column < 2 * n; ++column) {
    Eigen::VectorXd improved = end_of_step(step, Eigen::VectorXd::Zero(change.rows()));
    if (column >= n) improved[column - n] += step.h;
    // A method that has another rule for loads than for forces keeps its steps.
    constexpr double rounding = 1e-13;
    const auto size = change.col(column).cwiseAbs().array() + 1.0;
    if (((improved - change.col(column)).cwiseAbs().array() <= rounding * size).all())
      change.col(column) = improved;
  }
}

template model::SmoothSystem<1> with_column_as_load(const model::SmoothSystem<1>&,
                                                    const Eigen::Index&);
template model::SmoothSystem<2> with_column_as_load(const model::SmoothSystem<2>&,
                                                    const Eigen::Index&);
template model::SmoothSystem<> with_column_as_load(const model::SmoothSystem<>&,
                                                   const Eigen::Index&);

}  // namespace clackers::methods
