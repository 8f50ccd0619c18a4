#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <iterator>
#include <memory>
#include <span>
#include <vector>

#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/model/sink.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::measure {

class StateErrors;

using FreeState = model::State<model::any_dof>;

/// Row `i` of a history that has velocities.
FreeState row_state(const model::Trajectory& rows, std::size_t i);

/// Highest undamped natural frequency without contact, at least 1e-3 [rad/s].
double highest_frequency(const model::SmoothSystem<>& system);

/// How a structure moves while nothing collides, from its equation of motion alone.
class FreeMotion {
 public:
  /// The system must outlive this; its mass matrix is positive definite.
  explicit FreeMotion(const model::SmoothSystem<>& system);
  explicit FreeMotion(model::SmoothSystem<>&&) = delete;

  /// M^-1 (f(t) - C v - K u - p(u, v)) [m/s^2].
  Eigen::VectorXd acceleration(double t, const Eigen::VectorXd& u, const Eigen::VectorXd& v) const;
  /// The state s [s] later, or earlier where s < 0: equal steps of the classical Runge-Kutta method of
  /// fourth order, local error O(s^5).
  FreeState moved(const FreeState& from, double s, int steps = 1) const;
  /// M^-1 b: the velocity that a unit impulse along b gives.
  Eigen::VectorXd response(const Eigen::VectorXd& b) const { return inverse_mass_ * b; }

  const model::SmoothSystem<>& system() const { return system_; }

 private:
  template <int Dof>
  model::Vector<Dof> acceleration_of(double t, const model::Vector<Dof>& u,
                                     const model::Vector<Dof>& v) const;
  template <int Dof>
  FreeState moved_by(const FreeState& from, double s, int steps) const;

  const model::SmoothSystem<>& system_;
  Eigen::MatrixXd inverse_mass_;
};

/// Kinetic energy v' M v / 2 and potential energy u' K u / 2 of a structure [J], and what a nonlinear force
/// stores; NaN where that has no potential.
class MechanicalEnergy {
 public:
  explicit MechanicalEnergy(const model::SmoothSystem<>& system);

  /// `v` [m/s] and `u` [m]: one entry a degree of freedom.
  double kinetic(const double* v) const { return 0.5 * form(mass_, v); }
  double potential(const double* u) const {
    return 0.5 * form(stiffness_, u) + (is_nonlinear() ? stored(u) : 0.0);
  }
  /// What the nonlinear force stores, where there is one.
  double stored(const double* u) const {
    return nonlinear_->potential(Eigen::Map<const Eigen::VectorXd>(u, dof_));
  }
  bool is_nonlinear() const { return nonlinear_ != nullptr; }
  double total(const double* u, const double* v) const { return kinetic(v) + potential(u); }

  /// The entries of a matrix that are not zero, row by row.
  struct Rows {
    std::vector<std::size_t> ends, columns;
    std::vector<double> values;
  };
  const Rows& mass() const { return mass_; }
  const Rows& stiffness() const { return stiffness_; }

 private:
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
  Eigen::Index dof_ = 0;
  std::shared_ptr<const model::NonlinearForce<model::any_dof>> nonlinear_;  // may be empty
};

inline std::vector<double> entries(const Eigen::VectorXd& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

/// The upper median; `values` must not be empty.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// What jumps at an impact.
enum class JumpingQuantity { velocity, acceleration };

/// The integral over time of |v - v*|, or of its square, mass by mass, by the trapezoidal rule
/// over a run's output times and, on both sides of them, its reported impacts. Valid across jumps.
///
/// - True velocities at output times are right limits.
/// - Where a reported impact at time s lies in the same interval between output times as its true
///   impact at t*, left limits are compared with left limits and right with right; between s and t*
///   one motion has jumped and the other has not, which adds |s - t*| times that difference.
///   Comparing both limits at s alone would count a jump over half an interval.
/// - Where a reported impact has no true one in its interval, both its limits are compared with the
///   true velocity at s.
/// - An interval with a true impact and no reported one contributes by the rule over output times.
/// - Where an impact is reported at an output time, its limits stand for the state delivered there,
///   which may be of either side.
///
/// The same rule serves accelerations, which take the place of velocities in all calls then.
class VelocityError {
 public:
  /// The motion must outlive this.
  explicit VelocityError(const model::Motion& reference,
                         JumpingQuantity quantity = JumpingQuantity::velocity);

  /// Takes the state at an output time with the true velocities, right limits. Times ascend. No impact
  /// taken later may lie before the last but one of them.
  void take(double t, std::span<const double> v, std::span<const double> v_reference);
  /// The same of many times, at most StateErrors::most, by their errors.
  void take(std::span<const double> t, StateErrors& errors);
  /// Takes an impact after the output times before it, before or after an output time equal to its
  /// own.
  void take(const model::ReportedImpact& impact);
  /// The integral [m] of one mass up to the last output time.
  double integral(int mass) const;
  /// The integral of the square [m^2/s].
  double integral_of_square(int mass) const;

 private:
  struct Jump {
    double t = 0.0;
    std::vector<double> before, after;
  };
  using Errors = std::vector<double>;

  void go_on(double t);
  void close();
  void pass(const Jump& jump, double& from, Errors& error);
  const model::MotionImpact* join(double from);
  std::span<const double> part(const model::Kinematics& now) const;
  void add(double length, const Errors& left, const Errors& right);

  const model::Motion& reference_;
  JumpingQuantity quantity_;
  std::size_t dof_;
  long long known_;                  ///< number of true impacts
  int taken_ = 0;                    ///< output times so far, counted up to 2
  double from_ = 0.0, to_ = 0.0;     ///< the interval between output times that is still open
  Errors from_error_, to_error_;     ///< after `from_`, and of the state delivered at `to_`
  std::vector<Jump> jumps_, later_;  ///< reported within (from_, to_], and after to_
  long long next_true_ = 1;          ///< no true impact before this one can be joined any more
  model::MotionImpact true_impact_;  ///< the one numbered next_true_, when fetched
  Errors sum_, squares_;
};

}  // namespace clackers::measure
