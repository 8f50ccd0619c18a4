#pragma once

#include "clackers/methods/method.hpp"
#include "clackers/methods/stepping/motion_equation.hpp"

namespace clackers::methods {

/// One-step methods with weighted equilibrium, x_m = (1 - alpha_f) x1 + alpha_f x0 for x = u, v, t:
///
///     M [(1 - alpha_m) a1 + alpha_m a0] + C v_m + K u_m + p(u_m, v_m) = f(t_m)
///     u1 = u0 + h v0 + h² [(1/2 - beta) a0 + beta a1]
///     v1 = v0 + h [(1 - gamma) a0 + gamma a1]
///
/// alpha_m = alpha_f = 0 is Newmark's method. With p the first line is solved by Newton's iteration
/// down to rounding. That a0 of a start belongs to t0, and not to the time that the equilibrium of a
/// step shifts it to, costs h² in v once, not a step.
struct AlphaMethod {
  double beta, gamma, alpha_m = 0.0, alpha_f = 0.0;

  Facts facts() const;

  // An alias instead of a base class: the struct stays an aggregate.
  template <int Dof>
  using Memory = AccelerationMemory::Memory<Dof>;

  template <int Dof>
  void prepare(MotionEquation<Dof>& equation, double h) const {
    equation.factorized(weights<Dof>(h));
  }

  template <int Dof>
  void advance(MotionEquation<Dof>& equation, double h, model::State<Dof>& x,
               Memory<Dof>& memory) const {
    auto& a = memory.a;
    if (alpha_m == 0.0 && alpha_f == 0.0) {
      // Predictors: the part of the new u and v that does not need the new acceleration.
      x.u += h * x.v + h * h * (0.5 - beta) * a;
      x.v += h * (1.0 - gamma) * a;
      equation.solve(x.t + h, weights<Dof>(h), x.u, x.v, a);
    } else {
      solve_weighted(equation, h, x, a);
    }
    x.u += h * h * beta * a;
    x.v += h * gamma * a;
    x.t += h;
  }

 private:
  // Not inlined: inlined it doubles the time of a plain Newmark step.
  template <int Dof>
  [[gnu::noinline]] void solve_weighted(MotionEquation<Dof>& equation, double h,
                                        model::State<Dof>& x, model::Vector<Dof>& a) const {
    Scratch<Dof> u_m = equation.scratch(0), v_m = equation.scratch(1), shift = equation.scratch(2);
    // x_m without the new acceleration: x0 plus (1 - alpha_f) of what the predictor adds to it.
    u_m = x.u + (1.0 - alpha_f) * (h * x.v + h * h * (0.5 - beta) * a);
    v_m = x.v + (1.0 - alpha_f) * h * (1.0 - gamma) * a;
    shift = alpha_m * a;
    x.u += h * x.v + h * h * (0.5 - beta) * a;
    x.v += h * (1.0 - gamma) * a;
    equation.solve(x.t + (1.0 - alpha_f) * h, weights<Dof>(h), u_m, v_m, a, &shift);
  }

  template <int Dof>
  typename MotionEquation<Dof>::Weights weights(double h) const {
    return {1.0 - alpha_m, (1.0 - alpha_f) * h * gamma, (1.0 - alpha_f) * h * h * beta};
  }
};

}  // namespace clackers::methods
