#pragma once

#include <vector>

#include "clackers/model/system.hpp"

namespace clackers::assess {

/// Kinetic energy v' M v / 2 and potential energy u' K u / 2 of a linear structure [J].
class MechanicalEnergy {
 public:
  explicit MechanicalEnergy(const model::SmoothSystem<>& system);

  /// `v` [m/s] and `u` [m]: one entry a degree of freedom.
  double kinetic(const double* v) const { return 0.5 * form(mass_, v); }
  double potential(const double* u) const { return 0.5 * form(stiffness_, u); }
  double total(const double* u, const double* v) const { return kinetic(v) + potential(u); }

 private:
  double form(const std::vector<double>& matrix, const double* x) const;

  std::size_t dof_;
  std::vector<double> mass_, stiffness_;  ///< row-major
};

}  // namespace clackers::assess
