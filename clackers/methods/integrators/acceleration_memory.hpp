#pragma once

#include "clackers/methods/stepping/motion_equation.hpp"

namespace clackers::methods {

/// What integrators share whose steps begin with the acceleration of the state before them.
struct AccelerationMemory {
  template <int Dof>
  struct Memory {
    explicit Memory(Eigen::Index dof) : a(model::Vector<Dof>::Zero(dof)) {}
    model::Vector<Dof> a;  ///< acceleration at the start of the step
  };

  template <int Dof>
  void start(MotionEquation<Dof>& equation, const model::State<Dof>& from,
             Memory<Dof>& memory) const {
    equation.accelerate(from.t, from.u, from.v, memory.a);
  }
};

}  // namespace clackers::methods
