#pragma once

#include "clackers/methods/method.hpp"
#include "clackers/methods/stepping/motion_equation.hpp"

namespace clackers::methods {

/// Newmark's step over H = theta h, whose acceleration is brought back to h on a line, x_H the
/// value at t0 + H for x = u, v and f extrapolated on a line:
///
///     u_H = u0 + H v0 + H² [(1/2 - beta) a0 + beta a_H]
///     v_H = v0 + H [(1 - gamma) a0 + gamma a_H],  gamma = 1/2
///     M a_H + C v_H + K u_H + p(u_H, v_H) = (1 - theta) f(t0) + theta f(t0 + h)
///     a1 = a0 + (a_H - a0)/theta; u1, v1 by the first two lines with h for H
struct CollocationMethod {
  double theta, beta;

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
    Scratch<Dof> u = equation.scratch(0), v = equation.scratch(1), a = equation.scratch(2);
    const double wide = theta * h;
    u = x.u + wide * x.v + wide * wide * (0.5 - beta) * memory.a;
    v = x.v + wide * 0.5 * memory.a;
    a = memory.a;
    equation.solve({x.t, x.t + h, theta}, weights<Dof>(h), u, v, a);
    a = memory.a + (1.0 / theta) * (a - memory.a);
    x.u += h * x.v + h * h * ((0.5 - beta) * memory.a + beta * a);
    x.v += h * 0.5 * (memory.a + a);
    memory.a = a;
    x.t += h;
  }

 private:
  template <int Dof>
  typename MotionEquation<Dof>::Weights weights(double h) const {
    return {1.0, 0.5 * theta * h, beta * theta * h * theta * h};
  }
};

}  // namespace clackers::methods
