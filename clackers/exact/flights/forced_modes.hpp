#pragma once

#include <string_view>
#include <vector>

#include "clackers/model/impact_problem.hpp"
#include "clackers/numerics/modal_flight.hpp"

namespace clackers::exact {

/// M a + C v + K u = f(t) between impacts: modes of free vibration, complex ones where the damping
/// couples them, and the steady response to harmonic forces. Modes without stiffness have none to a
/// constant force, which pushes them. A state z has the modal displacements
/// first and then their rates; u, v and a are matrices times z, and M^-1 f more of a.
///
/// The error of a flight is bounded by the defect of what was computed: the modes as they stand solve
/// their own equations but for rounding, and what they leave of those of the structure acts as a
/// force.
class ForcedModes {
 public:
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;

  /// Throws InputError, `who` first, for an invalid problem, a load that is no HarmonicLoad, a nonlinear force, stiffness
  /// or damping with a negative eigenvalue, modes of which the motion is no sum, and a force in
  /// resonance with an undamped mode.
  ForcedModes(const model::ImpactProblem<>& problem, std::string_view who);

  struct Force {
    double frequency = 0.0;                 ///< [rad/s]
    Eigen::VectorXcd acceleration, steady;  ///< e^(i phase) times M^-1 f, and the response z
    Eigen::VectorXd defect_per_time;  ///< what the response leaves of the equations, as a rate of z
  };
  /// Bounds on |y| and |y'| of each mode.
  struct Sizes {
    Vector y, rate;
  };

  const numerics::ModalSystem& system() const { return system_; }
  Eigen::Index dof() const { return mass_.rows(); }
  const Matrix& mass() const { return mass_; }
  const Matrix& stiffness() const { return stiffness_; }
  const std::vector<Force>& forces() const { return forces_; }
  /// The derivative of u of order 0 to 3 by z, without that of the forces.
  const Matrix& derivative(int order) const { return derivatives_[std::size_t(order)]; }

  Vector state(const Vector& u, const Vector& v) const;
  /// Change of z by a unit impulse along a direction.
  Vector impulse(const Vector& direction) const;
  /// z of the steady response.
  Vector steady(double t) const;
  /// z of the motion without the steady response s seconds later; `push` 0 without constant forces on
  /// modes that have no stiffness.
  Vector advanced(const Vector& z, double s, double push = 1.0) const;
  /// What those forces add to dz/dt.
  const Vector& push() const { return push_; }
  /// dz/dt of the modes alone.
  Vector rate(const Vector& z) const;
  /// The acceleration [m/s^2] in the state z, steady response included, at t.
  Vector acceleration(const Vector& z, double t) const;

  /// Over s seconds of that motion from z.
  Sizes sizes(const Vector& z, double s, double push = 1.0) const;
  /// |row z| with z between these sizes, where no mode grows.
  double bound(const Eigen::Ref<const Vector>& row, const Sizes& sizes) const;
  /// What rounding does to z in s seconds that begin with the free state z at t.
  Vector local_errors(const Vector& z, double t, double s) const;
  /// The covariance of errors of z, s seconds later.
  Matrix carried(const Matrix& covariance, double s) const;

 private:
  void add_forces(const model::ImpactProblem<>& problem, const Matrix& inverse_mass,
                  std::string_view who);
  void find_residuals();

  Matrix mass_, damping_, stiffness_;
  numerics::ModalSystem system_;
  std::vector<Matrix> derivatives_;
  Matrix inverse_, impulse_response_;       // z by (u, v), and by impulses
  Matrix basis_residual_, force_residual_;  // of z: its own error, and the rate of it
  Vector push_;
  std::vector<Force> forces_;
};

}  // namespace clackers::exact
