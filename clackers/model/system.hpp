#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace clackers::model {

/// Number of degrees of freedom, known at compile time for small systems, or this.
inline constexpr int any_dof = Eigen::Dynamic;

template <int Dof>
using Vector = Eigen::Matrix<double, Dof, 1>;
template <int Dof>
using Matrix = Eigen::Matrix<double, Dof, Dof>;

/// Displacement u [m] and velocity v [m/s] of all degrees of freedom at time t [s].
template <int Dof>
struct State {
  double t = 0.0;
  Vector<Dof> u, v;
};

/// Adds the load f(t) [N] to `force`, one entry a degree of freedom. Must not depend on anything
/// but t.
using Load = std::function<void(double t, std::span<double> force)>;

/// An internal force p(u, v) beside the linear ones, for M a + C v + K u + p(u, v) = f(t).
template <int Dof>
class NonlinearForce {
 public:
  virtual ~NonlinearForce() = default;
  /// p += p(u, v) [N].
  virtual void add(const Vector<Dof>& u, const Vector<Dof>& v, Vector<Dof>& p) const = 0;
  /// dp_du += dp/du [N/m], dp_dv += dp/dv [N s/m].
  virtual void add_tangent(const Vector<Dof>& u, const Vector<Dof>& v, Matrix<Dof>& dp_du,
                           Matrix<Dof>& dp_dv) const = 0;
  /// A part by_u b b^T of dp/du [N/m] and by_v b b^T of dp/dv [N s/m].
  struct TangentRow {
    const Vector<Dof>* b;
    double by_u, by_v;
  };
  /// Appends the tangents as such parts to `rows`, which point into the force. False where they have
  /// others.
  virtual bool add_tangent_rows(const Vector<Dof>& u, const Vector<Dof>& v,
                                std::vector<TangentRow>& rows) const {
    static_cast<void>(u), static_cast<void>(v), static_cast<void>(rows);
    return false;
  }
  /// The energy that p stores at u [J], 0 at u = 0; NaN where p has no potential.
  virtual double potential(const Vector<Dof>& u) const {
    static_cast<void>(u);
    return std::numeric_limits<double>::quiet_NaN();
  }
  /// True where derivatives of p jump, so that a step across a jump has an error of second order.
  virtual bool has_kinks() const { return false; }
};

/// M a + C v + K u + p(u, v) = f(t): how the structure moves while nothing collides.
/// M [kg] symmetric positive definite, C [N s/m] and K [N/m] symmetric; SI throughout.
template <int Dof = any_dof>
struct SmoothSystem {
  Matrix<Dof> mass, damping, stiffness;
  Load add_load{};                                         ///< empty: no load
  std::shared_ptr<const NonlinearForce<Dof>> nonlinear{};  ///< empty: linear

  Eigen::Index dof() const { return mass.rows(); }
};

}  // namespace clackers::model
