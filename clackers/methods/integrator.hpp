#pragma once

#include <memory>

#include "clackers/methods/method.hpp"
#include "clackers/methods/stepping/any_stepper.hpp"
#include "clackers/methods/stepping/step_plan.hpp"

namespace clackers::methods {

/// A method for smooth motion, with its parameters. A contact treatment makes steppers of it.
class Integrator {
 public:
  template <int Dof>
  using StepperPointer = std::unique_ptr<AnyStepper<Dof>>;

  virtual ~Integrator() = default;
  /// Claims nothing through impacts.
  virtual Facts facts() const = 0;
  /// The system must outlive the stepper. Throws InputError unless 0 < h < infinity, or the plan has
  /// a tolerance where it is adaptive, and for a system that it cannot step with h.
  virtual StepperPointer<1> stepper(const model::SmoothSystem<1>& system,
                                    const StepPlan& plan) const = 0;
  virtual StepperPointer<2> stepper(const model::SmoothSystem<2>& system,
                                    const StepPlan& plan) const = 0;
  virtual StepperPointer<model::any_dof> stepper(const model::SmoothSystem<>& system,
                                                 const StepPlan& plan) const = 0;
};

}  // namespace clackers::methods
