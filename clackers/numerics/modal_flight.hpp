#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "clackers/numerics/first_root.hpp"

namespace clackers::numerics {

/// y'' + 2 sigma y' + omega^2 y = 0. Any real sigma, omega^2 >= 0: underdamped, critical,
/// overdamped, growing, or free.
struct Mode {
  double sigma = 0.0;         ///< rate of decay [1/s]
  double omega_square = 0.0;  ///< undamped [1/s^2]
  double w = 0.0;      ///< sqrt |omega^2 - sigma^2|, of oscillation or of cosh and sinh [1/s]
  double omega = 0.0;  ///< undamped [1/s]

  Mode() = default;
  Mode(double decay, double square);
  bool oscillates() const { return omega_square > sigma * sigma; }
};

/// Displacement and rate of a mode.
struct ModalState {
  double y = 0.0, rate = 0.0;
};

/// The state of a mode `s` >= 0 seconds after `start`: e^(-sigma s) (p c(s) + r n(s)) with p = y,
/// r = rate + sigma y, c = cos w s and n = sin(w s)/w, or cosh and sinh, or 1 and s.
ModalState advance(const Mode& mode, const ModalState& start, double s);

/// M a + C v + K u = 0 where one set of mode shapes makes all three matrices diagonal: masses that
/// are not coupled, each with its own damping, or C a combination of M and K.
class ModalSystem {
 public:
  /// Nothing where the damping couples modes (by more than 1e-10 of its largest entry), the mass is
  /// not positive definite, the stiffness has a negative eigenvalue, or a number is not finite.
  static std::optional<ModalSystem> make(const Eigen::MatrixXd& mass,
                                         const Eigen::MatrixXd& damping,
                                         const Eigen::MatrixXd& stiffness);

  Eigen::Index dof() const { return shapes_.rows(); }
  const std::vector<Mode>& modes() const { return modes_; }
  /// Columns, normalised with the mass matrix.
  const Eigen::MatrixXd& shapes() const { return shapes_; }
  double fastest() const { return fastest_; }  ///< largest omega, or rate of decay [1/s]

  /// Modal states of the displacement u and the velocity v.
  void to_modes(std::span<const double> u, std::span<const double> v,
                std::span<ModalState> modes) const;
  /// u and v, s seconds after the modal states `start`. `v` may be empty.
  void sample(std::span<const ModalState> start, double s, std::span<double> u,
              std::span<double> v) const;

 private:
  std::vector<Mode> modes_;
  Eigen::MatrixXd shapes_, inverse_;  // inverse = shapes' M
  bool diagonal_ = false;
  double fastest_ = 0.0;
};

/// sign (offset + sum row_j y_j(s)), its rate, and the bound on its curvature that first_root needs:
/// |y''| <= sqrt(4 sigma^2 + omega^2) sqrt(y'^2 + omega^2 y^2), whose last factor does not grow
/// where sigma >= 0 and grows by e^(2 |sigma| s) at most elsewhere.
LocalBound linear_form(const ModalSystem& system, std::span<const ModalState> start,
                       std::span<const double> row, double offset, double sign, double s);

}  // namespace clackers::numerics
