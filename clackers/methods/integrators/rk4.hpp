#pragma once

#include <string_view>
#include <vector>

#include "clackers/base/check.hpp"
#include "clackers/methods/integrators/motion_equation.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"

namespace clackers::methods {

/// The classical Runge-Kutta method of four stages on (u, v)' = (v, a(t, u, v)), with
/// a(t, u, v) = M^-1 [f(t) - C v - K u - p(u, v)], the stages of u written out:
///
///     k1 = a(t0,       u0,                       v0)
///     k2 = a(t0 + h/2, u0 + h/2 v0,              v0 + h/2 k1)
///     k3 = a(t0 + h/2, u0 + h/2 v0 + h²/4 k1,    v0 + h/2 k2)
///     k4 = a(t0 + h,   u0 + h v0 + h²/2 k2,      v0 + h k3)
///     u1 = u0 + h v0 + h²/6 (k1 + k2 + k3)
///     v1 = v0 + h/6 (k1 + 2 k2 + 2 k3 + k4)
///
/// Order       4.
/// Stability   omega h <= 2 sqrt(2) = 2.828.
/// Dissipation of order (omega h)^6 a step below the limit.
/// Memory      none.
/// Cost        four force evaluations a step.
/// Source      W. Kutta, Z. Math. Phys. 46, 435-453 (1901).
struct Rk4 {
  static constexpr std::string_view name = "rk4";
  static constexpr std::string_view summary = "the classical Runge-Kutta method of order four";
  static const std::vector<Field<Rk4>>& fields();

  void validate() const {}
  Facts facts() const;

  template <int Dof>
  class Stepper;
};

/// One trajectory under the classical Runge-Kutta method. After construction nothing is allocated.
template <int Dof>
class Rk4::Stepper {
 public:
  using State = model::State<Dof>;
  using Vector = model::Vector<Dof>;

  /// The system must outlive the stepper. Throws InputError unless 0 < h < infinity.
  Stepper(const Rk4&, const model::SmoothSystem<Dof>& system, double h)
      : h_(require_step("rk4", h)),
        equation_(system),
        by_u_(system.stiffness),
        by_v_(system.damping),
        k1_(Vector::Zero(system.dof())),
        k2_(k1_),
        k3_(k1_),
        k4_(k1_),
        u_(k1_),
        v_(k1_) {
    rebuild();
  }

  /// Takes in changed matrices of the system.
  void rebuild() {
    equation_.rebuild();
    by_u_ = -equation_.system().stiffness;
    by_v_ = -equation_.system().damping;
    equation_.mass().solve_in_place(by_u_);
    equation_.mass().solve_in_place(by_v_);
    is_free_ = equation_.is_free();
  }

  /// Starts at `from`, or starts again after a jump in velocity.
  void restart(const State& from) {
    start_ = from.t;
    steps_ = 0;
  }

  /// Moves `now` from t to t + h.
  void step(State& now) {
    advance(now, h_);
    now.t = start_ + double(++steps_) * h_;  // a sum of h would drift
  }

  /// Takes the last step() back, once: the next step or partial step is from the state before it.
  void undo() { --steps_; }

  /// The state s after `from`, 0 < s <= h. Valid until the next call. For locating impacts.
  const State& partial(const State& from, double s) {
    to_ = from;
    advance(to_, s);
    return to_;
  }

  /// An explicit step cannot fail.
  static constexpr bool failed() { return false; }
  static constexpr Code failure() { return "run-failed"; }
  /// Forgets counts, for a new run.
  void reset() { equation_.reset(); }
  void add_work(model::Work& work) const { equation_.add_work(work); }

 private:
  // One branch a step and not one a stage: what is free needs no load and no solution with M.
  void advance(State& x, double h) {
    if (is_free_) {
      stages(x, h, [this](double, const Vector& u, const Vector& v, Vector& a) {
        a.noalias() = by_u_ * u;
        a.noalias() += by_v_ * v;
      });
      equation_.count_evaluations(4);
    } else {
      stages(x, h, [this](double t, const Vector& u, const Vector& v, Vector& a) {
        equation_.accelerate(t, u, v, a);
      });
    }
  }

  template <class Accelerate>
  void stages(State& x, double h, Accelerate&& accelerate) {
    const double half = 0.5 * h, middle = x.t + half;
    Scratch<Dof> k1 = k1_, k2 = k2_, k3 = k3_, k4 = k4_, u = u_, v = v_;
    accelerate(x.t, x.u, x.v, k1);
    u = x.u + half * x.v;
    v = x.v + half * k1;
    accelerate(middle, u, v, k2);
    u += half * half * k1;
    v = x.v + half * k2;
    accelerate(middle, u, v, k3);
    u = x.u + h * x.v + half * h * k2;
    v = x.v + h * k3;
    accelerate(x.t + h, u, v, k4);
    const double sixth = h / 6.0;
    x.u += h * (x.v + sixth * (k1 + k2 + k3));
    x.v += sixth * (k1 + 2.0 * (k2 + k3) + k4);
    x.t += h;
  }

  double h_, start_ = 0.0;
  MotionEquation<Dof> equation_;
  model::Matrix<Dof> by_u_, by_v_;  // -M^-1 K and -M^-1 C: a = by_u u + by_v v
  Vector k1_, k2_, k3_, k4_, u_, v_;
  State to_;
  long long steps_ = 0;
  bool is_free_ = true;
};

}  // namespace clackers::methods
