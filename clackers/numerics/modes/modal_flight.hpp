#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace clackers::numerics {

/// Whether all entries off the diagonal are 0.
bool is_diagonal(const Eigen::MatrixXd& x);

/// y'' + 2 sigma y' + omega^2 y = 0. Any real sigma and omega^2: underdamped, critical, overdamped,
/// growing, or free.
struct Mode {
  double sigma = 0.0;         ///< rate of decay [1/s]
  double omega_square = 0.0;  ///< undamped; below 0 for an unstable equilibrium [1/s^2]
  double w = 0.0;      ///< sqrt |omega^2 - sigma^2|, of oscillation or of cosh and sinh [1/s]
  double omega = 0.0;  ///< sqrt |omega^2| [1/s]

  Mode() = default;
  Mode(double decay, double square);
  bool oscillates() const { return omega_square > sigma * sigma; }
  /// y'' of a state.
  double acceleration(double y, double rate) const {
    return -2.0 * sigma * rate - omega_square * y;
  }
  /// sqrt(rate^2 + omega^2 y^2) of the motion does not grow faster than e^(growth s).
  double growth() const;
};

/// Displacement and rate of a mode.
struct ModalState {
  double y = 0.0, rate = 0.0;
};

/// The state of a mode `s` >= 0 seconds after `start`: e^(-sigma s) (p c(s) + r n(s)) with p = y,
/// r = rate + sigma y, c = cos w s and n = sin(w s)/w, or cosh and sinh, or 1 and s.
ModalState advance(const Mode& mode, const ModalState& start, double s);

/// The same from rest where a constant force adds push.y to y' and push.rate to y''. It does not cancel where omega s is
/// small, as displacements about the static one do.
ModalState pushed(const Mode& mode, const ModalState& push, double s);

/// M a + C v + K u = 0 as a sum of modes,
///
///     u = sum_j shape_j y_j + rate_shape_j y_j'
///
/// where each y_j obeys an equation of its own. Damping that does not couple the modes of M and K has
/// rate shapes of 0: y_j are those modes. What it does couple has its modes from the complex
/// eigenvectors x of the first-order equations: of an eigenvalue -sigma + i w, w > 0, the shapes
/// Re x + (sigma/w) Im x and (Im x)/w.
class ModalSystem {
 public:
  ModalSystem() = default;
  /// Nothing where the mass is not positive definite, a number is not finite, or coupled modes have
  /// equal eigenvalues but not as many eigenvectors, so that no sum of modes is the motion (a matrix of
  /// eigenvectors with a condition above 1e5).
  static std::optional<ModalSystem> make(const Eigen::MatrixXd& mass,
                                         const Eigen::MatrixXd& damping,
                                         const Eigen::MatrixXd& stiffness);

  /// Of modes that nothing couples and their shapes; y = coordinates u.
  ModalSystem(std::vector<Mode> modes, Eigen::MatrixXd shapes, Eigen::MatrixXd coordinates);

  /// The motion u = basis q, whose coordinates q = inverse u move like this one.
  ModalSystem seen_through(const Eigen::MatrixXd& basis, const Eigen::MatrixXd& inverse) const;

  Eigen::Index dof() const { return shapes_.rows(); }  ///< of u; there may be fewer modes
  const std::vector<Mode>& modes() const { return modes_; }
  /// Columns; normalised with the mass matrix where the damping does not couple them.
  const Eigen::MatrixXd& shapes() const { return shapes_; }
  const Eigen::MatrixXd& rate_shapes() const { return rate_shapes_; }  ///< empty where they are 0
  /// y by u, where damping does not couple the modes.
  const Eigen::MatrixXd& coordinates() const { return inverse_; }
  /// Whether damping couples them.
  bool is_coupled() const { return whole_inverse_.size() > 0; }
  double fastest() const { return fastest_; }  ///< largest omega, or rate of decay [1/s]

  /// The derivative of u of this order is this matrix times (y_1, y_2, ..., y_1', y_2', ...).
  Eigen::MatrixXd derivative(int order) const { return derivative(order, 0, dof()); }
  /// `count` rows of it from `first` on.
  Eigen::MatrixXd derivative(int order, Eigen::Index first, Eigen::Index count) const;
  /// (y_1, y_2, ..., y_1', y_2', ...) are this matrix times (u, v).
  Eigen::MatrixXd inverse() const;

  /// Modal states of the displacement u and the velocity v.
  void to_modes(std::span<const double> u, std::span<const double> v,
                std::span<ModalState> modes) const;
  /// Amplitudes: |u_i| <= u_i and |v_i| <= v_i in the motion from `start` if nothing grows; of modes
  /// that move freely only where they start.
  void add_amplitudes(std::span<const ModalState> start, std::span<double> u,
                      std::span<double> v) const;
  /// u and v, s seconds after the modal states `start`. `v` may be empty.
  void sample(std::span<const ModalState> start, double s, std::span<double> u,
              std::span<double> v) const;

 private:
  bool add_coupled(const std::vector<Eigen::Index>& block, const Eigen::MatrixXd& damping,
                   const Eigen::MatrixXd& stiffness);

  std::vector<Mode> modes_;
  Eigen::MatrixXd shapes_, rate_shapes_;
  Eigen::MatrixXd inverse_;        // shapes' M
  Eigen::MatrixXd whole_inverse_;  // (u, v) to (y, y') where modes are coupled, otherwise empty
  bool diagonal_ = false;
  double fastest_ = 0.0;
};

}  // namespace clackers::numerics
