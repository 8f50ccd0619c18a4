#pragma once

#include <cstddef>
#include <vector>

#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::measure {

/// The largest differences between states of a run and of the reference, eight states at once. Products
/// and sums are rounded one by one in a fixed order, so that vectors of all lengths have the same bits.
class StateErrors {
 public:
  /// States of a call; a run delivers no more at once.
  static constexpr std::size_t most = 264;

  StateErrors(std::size_t dof, const model::SmoothSystem<>& system);

  /// Takes `count` states, 1 to `most`, row-major (state, mass). Where velocities are not known `v` is
  /// null and only displacements count.
  void take(std::size_t count, const double* u, const double* v, const double* u_reference,
            const double* v_reference);
  /// Takes displacements alone.
  void take_displacements(const double* found, const double* reference);

  const std::vector<double>& u() const { return totals_.u; }  ///< largest |u - u*| of each mass [m]
  double energy() const { return totals_.energy; }            ///< largest |E - E*| [J]
  /// E / E* of the last state; NaN where E* is 0.
  double energy_ratio() const;
  bool is_finite() const { return totals_.finite == 0.0; }
  /// |v - v*| of a mass [m/s], of the states of the last call; 8 numbers more may be read behind them.
  double* v(std::size_t mass) { return &totals_.v[mass * v_stride]; }

  static constexpr std::size_t v_stride = most + 8;
  struct Totals {
    std::vector<double> u, v, work;
    double energy = 0.0, last = 0.0, last_reference = 0.0;
    double finite = 0.0;  ///< 0 while every number is finite, then NaN
  };

 private:
  std::size_t dof_;
  MechanicalEnergy energies_;
  Totals totals_;
};

/// Adds the integrals of e and e^2 by the trapezoidal rule to sums[0] and sums[1]: over `count`
/// intervals, the first from e[0] to e[1]. half[i] is half the length of one; up to the next multiple of 8
/// both may be read, where half[i] is to be 0.
void add_trapezoids(std::size_t count, const double* half, const double* e, double* sums);

}  // namespace clackers::measure
