#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::exact {

/// The exact motion of a structure whose one contact is a linear spring that acts in compression
/// alone, as a penalty method has it: M a + C v + K u = -k min(g, 0) b, g = b . u - gap. What such a
/// method should compute, so that its integration error and the error of its model separate.
///
/// The motion consists of phases without and with contact. In each, displacements are a sum of
/// modes e^(-sigma s) (p cos w s + q sin w s), so damping must be C = 2 sigma M and every mode
/// underdamped; masses may be coupled. No phase ends unnoticed: from a known gap g with rate g'
/// the next zero is not before that of the parabola g + g' x - B x^2/2, where |g''| <= B = sum over
/// modes of |b . shape| amplitude omega^2 for the rest of the phase. Steps go from one such zero to
/// the next, never less than 1e-6/omega of the fastest mode: within such a step a gap dips by no
/// more than B x^2/8, 1.3e-13 of the amplitudes, less than rounding does to velocities.
///
/// The force is continuous where phases meet, so a wrong switching time has no effect of first order,
/// and no error grows at a switch. Source: piecewise modal superposition, common.
class PenalizedMotion : public model::Motion {
 public:
  /// `stiffness` k > 0 [N/m]. Throws InputError for an invalid problem, a load or a nonlinear force,
  /// a start at another time than 0, more or fewer than one contact, restitution other than 1,
  /// damping that is not 2 sigma M, a mode that is not underdamped, and more than 1e6 contacts.
  PenalizedMotion(const model::ImpactProblem<>& problem, double stiffness);

  int dof() const override { return static_cast<int>(start_.u.size()); }
  double end() const override { return end_; }
  double stiffness() const { return stiffness_; }

  /// Nothing jumps, so `side` does not matter.
  void sample(std::span<const double> times, model::Side side,
              model::SampleBuffers out) const override;
  /// Sums over modes of amplitude, amplitude times omega, and times omega^2, at t.
  model::Kinematics envelope(double t) const override;
  /// Bound to first order: rounding of every phase so far, carried on by the phases' own linear maps.
  model::Kinematics error_bound(double t) const override;

  /// Contacts that began in [0, t].
  long long impact_count(double t) const override;
  /// The beginning of a contact: both limits are the same and the impulse is 0, since the force acts
  /// later. `when` is the switching time with its error by error_bound().
  model::MotionImpact impact(long long index) const override;

 private:
  // The structure in one of the two regimes, mode by mode.
  struct Regime {
    Eigen::MatrixXd shapes;               // columns, normalised with the mass matrix
    Eigen::VectorXd omega, w;             // undamped and damped [1/s]
    Eigen::VectorXd static_displacement;  // displacement at rest [m]
    Eigen::VectorXd gap_shape;            // b . shape
    Eigen::MatrixXd stiffness;            // [N/m]
    Eigen::VectorXd omega_error;          // relative error of omega
  };
  struct Phase {
    double t = 0.0;
    bool closed = false;
    Eigen::VectorXd p, q;
    Eigen::MatrixXd error_covariance;  // sum of D D' of errors so far, of (u, v) at t
  };

  Regime regime(bool closed) const;
  const Regime& of(const Phase& phase) const { return regimes_[phase.closed ? 1 : 0]; }
  Phase begin(double t, bool closed, const Eigen::VectorXd& u, const Eigen::VectorXd& v) const;
  void modes(const Phase& phase, double s, Eigen::VectorXd& y, Eigen::VectorXd& rate) const;
  // The gap and its rate s seconds into a phase, with the sign that is positive during the phase.
  std::pair<double, double> signed_gap(const Phase& phase, double s) const;
  std::optional<double> phase_end(const Phase& phase) const;
  Eigen::MatrixXd flow(const Phase& phase, double s) const;
  Eigen::MatrixXd error_after(const Phase& phase, double s) const;
  std::size_t phase_at(double t) const;
  void require_index(long long index) const;

  model::SmoothSystem<> system_;
  model::Contact<> contact_;
  model::State<model::any_dof> start_;
  double end_, stiffness_, sigma_ = 0.0, shortest_step_ = 0.0;
  Regime regimes_[2];
  std::vector<Phase> phases_;
  std::vector<std::size_t> contacts_;  // their phases
};

}  // namespace clackers::exact
