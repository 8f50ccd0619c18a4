#pragma once

#include "clackers/methods/method.hpp"
#include "clackers/methods/stepping/motion_equation.hpp"

namespace clackers::methods {

/// A discrete gradient: the internal force is its mean over the chord of the step; see the card.
struct EnergyMomentum : AccelerationMemory {
  Facts facts() const;

  template <int Dof>
  void prepare(MotionEquation<Dof>& equation, double h) const {
    equation.factorized(weights<Dof>(h));
  }

  template <int Dof>
  void advance(MotionEquation<Dof>& equation, double h, model::State<Dof>& x,
               Memory<Dof>& memory) const {
    Scratch<Dof> u = equation.scratch(0);
    u = x.u + 0.5 * h * x.v;
    equation.solve_along_chord(x.u, {x.t, x.t + h, 0.5}, weights<Dof>(h), u, x.v, memory.a);
    x.u += h * x.v + 0.5 * h * h * memory.a;
    x.v += h * memory.a;
    x.t += h;
  }

 private:
  // Of the middle: v_m = v0 + h/2 a, u_m = u0 + h/2 v_m.
  template <int Dof>
  typename MotionEquation<Dof>::Weights weights(double h) const {
    return {1.0, 0.5 * h, 0.25 * h * h};
  }
};

}  // namespace clackers::methods
