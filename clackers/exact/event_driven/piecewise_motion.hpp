#pragma once

#include <complex>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/model/harmonic_load.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/numerics/first_root.hpp"
#include "clackers/numerics/modal_flight.hpp"

namespace clackers::exact {

/// The motion of any linear structure with contacts, flight by flight: between impacts modes of free
/// vibration and the steady response to harmonic forces, impacts located by steps that pass no
/// contact (numerics/first_root.hpp). Contacts that close together, within the error of their
/// gaps, obey Newton's law all at once: impulses p >= 0, b . v(+) >= -restitution b . v(-), one of
/// each pair an equality; a linear complementarity problem.
///
/// error_bound() holds to first order in rounding: the errors of each flight, among them those of mode
/// shapes and frequencies by their residuals, are carried on by the flights' own maps and through
/// each impact by its saltation matrix. The whole motion is refused where errors of that size decide
/// whether masses touch.
/// Const, safe to share between threads. Source: piecewise modal superposition, common.
class PiecewiseMotion : public model::Motion {
 public:
  /// Throws InputError for an invalid problem, a start at another time than 0, a load that is no
  /// HarmonicLoad, a nonlinear force, stiffness or damping with a negative eigenvalue, damping that
  /// couples the modes of M and K, a force in resonance with an undamped mode, two contacts in the same
  /// direction; and where the motion is not available: masses that stay in contact, a contact that is
  /// approached to less than the error, more than 1e5 flights, more than 2 GB of errors.
  explicit PiecewiseMotion(const model::ImpactProblem<>& problem,
                           std::string_view who = "piecewise");

  int dof() const override { return int(system_.dof()); }
  double end() const override { return end_; }
  void sample(std::span<const double> times, model::Side side,
              model::SampleBuffers out) const override;
  /// What the modes of the present flight can add up to, and the steady response.
  model::Kinematics envelope(double t) const override;
  model::Kinematics error_bound(double t) const override;
  long long impact_count(double t) const override;
  /// Of contacts that close together each is an impact of its own, with the velocities before and
  /// after all of them.
  model::MotionImpact impact(long long index) const override;

  const numerics::ModalSystem& modes() const { return system_; }

 private:
  using Modal = std::vector<numerics::ModalState>;
  class Builder;
  struct Force {
    double frequency = 0.0;
    Eigen::VectorXcd modal, steady;  // e^(i phase) times force and response of each mode
  };
  struct Flight {
    double t = 0.0;
    Modal free;                  // without the steady response
    Eigen::MatrixXd covariance;  // sum of D D' of the errors so far, of (y, rate) at t
  };
  struct Hit {
    double t = 0.0, time_error = 0.0, impulse = 0.0;
    int contact = 0;
    std::size_t flight = 0;  // the one that it ends
  };

  void add_forces(std::string_view who, const model::HarmonicLoad& load);
  void find_residuals();
  // All modal numbers at t: state, and force, of the steady response or in total.
  Modal steady(double t) const;
  Modal total(const Flight& flight, double t) const;
  Eigen::VectorXd acceleration(const Modal& state, double t) const;
  // Bounds over s seconds of a flight on |y| and |rate| of each mode.
  struct Sizes {
    Eigen::VectorXd y, rate;
  };
  Sizes sizes(const Flight& flight, double s) const;
  Sizes local_errors(const Flight& flight, double s) const;
  Eigen::MatrixXd covariance_after(const Flight& flight, double s) const;
  double factor(std::size_t flight) const;
  std::size_t flight_at(double t, model::Side side) const;

  std::string who_;
  Eigen::MatrixXd mass_, stiffness_, damping_;
  double end_ = 0.0;
  numerics::ModalSystem system_;
  Eigen::MatrixXd stiffness_residual_, damping_residual_, mass_residual_;
  std::vector<Force> forces_;
  std::vector<Flight> flights_;
  std::vector<Hit> hits_;
};

}  // namespace clackers::exact
