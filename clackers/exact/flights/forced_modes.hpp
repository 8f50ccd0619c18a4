#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <complex>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/exact/flights/basis.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/numerics/double_double.hpp"
#include "clackers/numerics/first_root.hpp"
#include "clackers/numerics/linear_algebra.hpp"
#include "clackers/numerics/modes/modal_form.hpp"

namespace clackers::exact {

/// M a + C v + K u = f(t) between impacts: modes of free vibration, complex ones where the damping
/// couples them, and the steady response to harmonic forces. Modes that turn by a radian at most up to the end, as
/// those without stiffness, have none to a constant force, which pushes them from the start of each flight. A state z
/// has the modal displacements first and then their rates; u, v and a are matrices times z, and M^-1 f more of a.
///
/// The error of a flight is bounded by the defect of what was computed: the modes as they stand solve
/// their own equations but for rounding, and what they leave of those of the structure acts as a
/// force. Undamped structures of three diagonals, such as meshes of bars, have modes without such a defect
/// (tridiagonal_modes.hpp). The bounds are in forced_mode_errors.cpp, what is observed in observables.cpp.
class ForcedModes {
 public:
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;
  using Sparse = Eigen::SparseMatrix<double>;

  /// Throws InputError, `who` first, for a load that is no HarmonicLoad, a nonlinear force, modes of
  /// which the motion is no sum. Bounds hold where stiffness and damping have no negative eigenvalue.
  ForcedModes(const model::ImpactProblem<>& problem, std::string_view who)
      : ForcedModes(problem, who, Matrix::Identity(problem.dof(), problem.dof()),
                    Vector::Zero(problem.dof())) {}
  /// What a stiffness and the constant forces are more than their doubles say.
  struct Rest {
    Matrix stiffness;
    Vector force;
  };
  /// The same structure where constraints without friction leave u = offset + basis q. z is the
  /// modal state of q; u, v and a are of the structure. `precise`: in double-double as well, where
  /// that is possible.
  ForcedModes(const model::ImpactProblem<>& problem, std::string_view who, const Matrix& basis,
              const Vector& offset, const Rest& rest = {}, bool precise = false);

  using Numbers = std::vector<numerics::DoubleDouble>;

  /// The response of a mode to a force at or near its frequency.
  struct Resonance {
    Eigen::Index mode = 0;
    numerics::Beat beat;
    numerics::BeatForm y, rate;
  };
  struct Force {
    double frequency = 0.0;                 ///< [rad/s]
    Eigen::VectorXcd applied;               ///< f e^(i phase) [N]
    Eigen::VectorXcd acceleration, steady;  ///< what it does to a, and the response z
    Eigen::VectorXd defect_per_time;  ///< what the response leaves of the equations, as a rate of z
    std::vector<Resonance> resonances;  ///< of modes whose `steady` is only what is left
    /// Bounds on |z| of the response up to t.
    Vector sizes(double t) const;
  };
  /// A linear function of u, v, a and the loads, such as a gap or the force of a constraint:
  /// constant + by_state.col(0) . z + the real parts of response e^(i frequency t), of the free state z.
  struct Observable {
    Matrix by_state;  ///< a column for each derivative, of order 0 to 4
    Vector size;      ///< what was added up for the first of them
    double constant = 0.0, constant_size = 0.0;
    std::vector<std::complex<double>> response;  ///< to each force
    std::vector<double> direct_size;
    numerics::ModalForm form;  ///< of the free state
    /// In double-double: of y, not of the free part of it; bounds on the errors of that.
    Numbers precise;
    numerics::DoubleDouble precise_constant;
    Vector precise_errors;
    double precise_constant_error = 0.0;
    bool vanishes() const {
      return constant == 0.0 && by_state.isZero(0.0) &&
             std::ranges::all_of(response, [](const auto& x) { return x == 0.0; });
    }
  };
  /// Bounds on |y| and |y'| of each mode.
  struct Sizes {
    Vector y, rate;
  };

  const numerics::ModalSystem& system() const { return system_; }
  /// Of the modes; the structure may have more.
  Eigen::Index dof() const { return std::ssize(system_.modes()); }
  const Sparse& mass() const { return mass_; }
  const Sparse& damping() const { return damping_; }
  const Sparse& stiffness() const { return stiffness_; }
  const Vector& offset() const { return offset_; }
  const std::vector<Force>& forces() const { return forces_; }
  /// The derivatives of u of that order in states z, one a column, without that of the forces.
  Matrix derived_states(int order, const Matrix& z) const;
  /// What is added up for them where |z| has these sizes.
  Vector derived_sizes(int order, const Vector& z) const;
  Vector displacement(const Vector& z) const { return offset_ + derived_states(0, z); }
  Vector velocity(const Vector& z) const { return derived_states(1, z); }
  /// The row of which row . z is the time derivative, modes alone.
  Vector derived(const Vector& row) const;

  Vector state(const Vector& u, const Vector& v) const { return change(u - offset_, v); }
  /// Change of z by a unit impulse along a direction.
  Vector impulse(const Vector& direction) const;
  /// on_u . u + on_v . v + on_a . a + on_load . f + constant
  Observable observe(const Vector& on_u, const Vector& on_v, const Vector& on_a,
                     const Vector& on_load, double constant) const;
  /// A free state for the next.
  static std::vector<numerics::ModalState> states(const Vector& free);
  /// `sign` times it, from t on, where the free state is `free`.
  void look_ahead(numerics::FormAhead& to, const Observable& seen,
                  std::span<const numerics::ModalState> free, double t, double sign = 1.0) const;
  /// At t itself.
  numerics::LocalBound now(const Observable& seen, const Vector& free, double t) const;
  /// A bound on its fourth derivative.
  double fourth_bound(const Observable& seen, const Vector& free, double horizon) const;
  /// What rounding does to it in a state of these sizes, at t.
  double rounding(const Observable& seen, const Sizes& size, double t) const;
  /// z of these displacements and velocities with what the constraints exclude removed from them, the
  /// momenta along the constrained motion as they are.
  Matrix change(const Matrix& u, const Matrix& v) const;
  /// y of mode j as a row times the state z of other modes.
  Vector displacement_of_mode(Eigen::Index j, const ForcedModes& other) const {
    return other.row(0, system_.coordinates().row(j).transpose());
  }
  /// z of the steady response; of resonances one that is 0 at t = 0.
  Vector steady(double t) const;
  /// Bounds up to t on the derivatives of u of that order in it.
  Vector steady_sizes(int order, double t) const;
  /// z of the motion without the steady response s seconds later; `push` 0 without the constant forces that
  /// push.
  Vector advanced(const Vector& z, double s, double push = 1.0) const;
  /// dz/dt of the modes alone.
  Vector rate(const Vector& z) const;
  /// The acceleration [m/s^2] in the state z, steady response included, at t.
  Vector acceleration(const Vector& z, double t) const;

  /// Over s seconds of that motion from z.
  Sizes sizes(const Vector& z, double s, double push = 1.0) const;
  /// |row z| with z between these sizes, where no mode grows.
  double bound(const Eigen::Ref<const Vector>& row, const Sizes& sizes) const;
  /// What rounding does to z in s seconds that begin with the free state z at t; with `precise` in double-double.
  Vector local_errors(const Vector& z, double t, double s, bool precise = false) const;
  /// What rounding does to z that is found in doubles from a state that was found in double-double.
  Vector rounding_errors(const Vector& z, double t, double s) const;
  /// What the modes leave of the equations of the structure, as accelerations, where |z| has these sizes.
  Vector acceleration_defect(const Vector& whole) const;

  // In double-double, with the response to forces in z; precise_modes.cpp.

  /// Modes without a defect, constant forces, and constraints that are displacements of a mass or of two.
  bool is_precise() const { return precise_.has_value(); }
  Numbers precise_state(const Numbers& u, const Numbers& v) const;
  /// What z is wrong by where it is found of u and v or these of it.
  Vector precise_change_errors(const Vector& z) const;
  /// u and v.
  std::pair<Numbers, Numbers> precise_motion(const Numbers& z) const;
  Numbers precise_advanced(const Numbers& z, const numerics::DoubleDouble& s) const;
  /// row . (z_first, z_first+1, ...)
  static numerics::DoubleDouble dot(const Numbers& row, const Numbers& z, std::size_t first = 0);
  static numerics::DoubleDouble precise_value(const Observable& seen, const Numbers& z) {
    return seen.precise_constant + dot(seen.precise, z);
  }
  static numerics::DoubleDouble precise_slope(const Observable& seen, const Numbers& z) {
    return dot(seen.precise, z, seen.precise.size());
  }

 private:
  struct Precise {
    Matrix shapes;                              // what they are more than their doubles
    Numbers squares, omega, half_turns, loads;  // of each mode; half_turns omega/pi
    Numbers forces;                             // on the structure
    Vector square_errors, load_errors;
    double unit, shape_error, least_mass;
    double change_error;  // of a change to these modes, of the sum of their sizes
  };
  void make_precise(const numerics::TridiagonalModes& modes, const model::HarmonicLoad* load,
                    const Rest& rest);
  numerics::DoubleDouble precise_shape(Eigen::Index i, Eigen::Index j) const {
    return {system_.shapes()(i, j), precise_->shapes(i, j)};
  }
  void observe_precisely(const Vector& on_u, const Vector& on_a, const Vector& on_load,
                         double constant, Observable& seen) const;

  /// The accelerations that forces on the structure give it.
  using Accelerations = std::function<Matrix(const Matrix&)>;
  void add_force(const Eigen::VectorXcd& applied, double frequency,
                 const Accelerations& accelerations);
  void find_residuals();
  /// Of direction . u^(order) as a row times z; of the sizes of what is added up.
  Vector row(int order, const Vector& direction) const;
  Vector row_of_sizes(int order, const Vector& direction) const;
  /// What is added up for the change of z by an impulse of these sizes.
  Vector impulse_sizes(const Vector& impulse) const;
  /// How far z may be from the state that it stands for, and what acts as a force on each mode, where the
  /// modes and the steady response have these sizes.
  Vector shift(const Vector& whole) const;
  Vector defect(const Vector& whole, bool precise = false) const;

  Sparse mass_, damping_, stiffness_;
  Basis onto_;
  numerics::ModalSystem system_;  // of u - offset
  Vector offset_;
  double seconds_ = 0.0;                    // up to the end
  Matrix impulse_response_;                 // z by impulses, where damping couples modes
  Matrix basis_residual_, force_residual_;  // of z: its own error, and the rate of it
  Vector square_errors_;                    // of modes without a defect, instead of the residuals
  std::vector<numerics::ModalState> push_;  // what constant forces add to dz/dt; empty for none
  std::vector<Force> forces_;
  std::optional<Precise> precise_;
};

}  // namespace clackers::exact
