#pragma once

#include "clackers/methods/method.hpp"
#include "clackers/methods/stepping/motion_equation.hpp"

// Explicit methods of one or two accelerations a step; a(t, u, v) = M^-1 [f(t) - C v - K u - p(u, v)].
namespace clackers::methods {

/// What the methods of this file share.
struct ExplicitStep : AccelerationMemory {
  template <int Dof>
  void prepare(MotionEquation<Dof>&, double) const {}
};

/// u1 = u0 + h v0 + h²/2 a0,  a1 = a(t1, u1, v0 + h a0),  v1 = v0 + h/2 (a0 + a1)
struct VelocityVerlet : ExplicitStep {
  Facts facts() const { return {.smooth_order = 2.0, .stability_limit = 2.0}; }

  template <int Dof>
  void advance(MotionEquation<Dof>& equation, double h, model::State<Dof>& x,
               Memory<Dof>& memory) const {
    Scratch<Dof> v = equation.scratch(0);
    x.u += h * x.v + 0.5 * h * h * memory.a;
    v = x.v + h * memory.a;
    x.v += 0.5 * h * memory.a;
    x.t += h;
    equation.accelerate(x.t, x.u, v, memory.a);
    x.v += 0.5 * h * memory.a;
  }
};

/// (1 - alpha_m) a1 + alpha_m a0 = a(t0, u0, v0), u1 and v1 by Newmark's formulas
struct ExplicitAlpha : ExplicitStep {
  /// A restart between steps costs its regularity: a1 belongs to an earlier instant than u1.
  static constexpr bool keeps_acceleration = true;

  double alpha_m, beta, gamma, limit;

  Facts facts() const {
    return {.smooth_order = 2.0, .stability_limit = limit, .scatters_pressed = true};
  }

  template <int Dof>
  void advance(MotionEquation<Dof>& equation, double h, model::State<Dof>& x,
               Memory<Dof>& memory) const {
    Scratch<Dof> a = equation.scratch(0);
    equation.accelerate(x.t, x.u, x.v, a);
    a = (a - alpha_m * memory.a) / (1.0 - alpha_m);
    x.u += h * x.v + h * h * ((0.5 - beta) * memory.a + beta * a);
    x.v += h * ((1.0 - gamma) * memory.a + gamma * a);
    x.t += h;
    memory.a = a;
  }
};

/// v1 = v0 + h a0,  u1 = u0 + h v0 + phi h² a0,  a1 = a(t1, u1, v1)
struct TchamwaWielgosz : ExplicitStep {
  double phi;

  Facts facts() const;

  template <int Dof>
  void advance(MotionEquation<Dof>& equation, double h, model::State<Dof>& x,
               Memory<Dof>& memory) const {
    x.u += h * x.v + phi * h * h * memory.a;
    x.v += h * memory.a;
    x.t += h;
    equation.accelerate(x.t, x.u, x.v, memory.a);
  }
};

/// Two sub-steps, of p h and of (1 - p) h; see the card.
struct NohBathe : ExplicitStep {
  double p;

  double q1() const { return (1.0 - 2.0 * p) / (2.0 * p * (1.0 - p)); }
  double q2() const { return 0.5 - p * q1(); }
  double q0() const { return 0.5 - q1() - q2(); }

  Facts facts() const;

  template <int Dof>
  void advance(MotionEquation<Dof>& equation, double h, model::State<Dof>& x,
               Memory<Dof>& memory) const {
    Scratch<Dof> v = equation.scratch(0), a = equation.scratch(1);
    const double first = p * h, second = (1.0 - p) * h, start = x.t;
    x.u += first * x.v + 0.5 * first * first * memory.a;
    v = x.v + first * memory.a;
    equation.accelerate(start + first, x.u, v, a);
    x.v += 0.5 * first * (memory.a + a);
    x.u += second * x.v + 0.5 * second * second * a;
    v = x.v + second * a;
    x.v += second * (q0() * memory.a + (0.5 + q1()) * a);
    x.t = start + h;
    equation.accelerate(x.t, x.u, v, memory.a);
    x.v += second * q2() * memory.a;
  }
};

}  // namespace clackers::methods
