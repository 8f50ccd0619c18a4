#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>

#include "clackers/base/codes.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/methods/stepping/step_plan.hpp"
#include "clackers/methods/stepping/step_powers.hpp"
#include "clackers/model/run.hpp"
#include "clackers/model/system.hpp"

namespace clackers::methods {

/// One trajectory of an integrator, as a contact treatment sees it. Steps are made in blocks, so
/// that a virtual call costs nothing beside them. After construction nothing is allocated, except
/// by a nonlinear force or a load.
template <int Dof>
class AnyStepper {
 public:
  using State = model::State<Dof>;

  static constexpr std::size_t most_steps = 64;  ///< in a block

  virtual ~AnyStepper() = default;

  /// Takes in changed matrices of the system.
  virtual void rebuild() = 0;
  /// Starts at `from`, or starts again after a jump in velocity: what the integrator remembers of
  /// the steps before no longer holds.
  virtual void restart(const State& from) = 0;
  /// Goes on from `now`, the end of a partial step of s from `from`: with the memory of that step
  /// where an integrator says that its acceleration is not that of the state, else by restart().
  virtual void go_on(const State& from, double s, const State& now) {
    static_cast<void>(from), static_cast<void>(s);
    restart(now);
  }
  /// Fills states[i], i >= 1, from states[0], the state at step `first` of the plan; times are counted,
  /// or an adaptive one's own. Returns the number of steps: up to one that failed or ends the plan.
  virtual std::size_t advance(long long first, std::span<State> states) = 0;
  /// Goes on from `now` by at most `most` whole steps for as long as the cubics of all gaps stay open;
  /// see StepPowers::advance(). `now` becomes the state after them, but for its time. Returns their
  /// number; 0 where the stepper cannot.
  virtual std::size_t fly(State& now, const Gaps& gaps, std::size_t most, double* u, double* v) {
    static_cast<void>(now), static_cast<void>(gaps), static_cast<void>(most);
    static_cast<void>(u), static_cast<void>(v);
    return 0;
  }
  /// Goes back into the block that advance() has just filled, to states[steps]: the next step or
  /// partial step is from there. The work is that of one step more, since its end has been seen.
  virtual void rewind(long long first, std::span<const State> states, std::size_t steps) = 0;
  /// The state s after `from`, 0 < s <= h, `from` the state before the next step; of an adaptive one
  /// in the step that rewind() went back before. Valid until the next call. For locating impacts.
  virtual const State& partial(const State& from, double s) = 0;

  /// True after a step whose equations could not be solved; its state is meaningless.
  virtual bool failed() const = 0;
  virtual Code failure() const = 0;
  /// Forgets failures and counts, for a new run.
  virtual void reset() = 0;
  virtual void add_work(model::Work& work) const = 0;
};

/// A method for smooth motion, with its parameters. A contact treatment makes steppers of it.
class Integrator {
 public:
  template <int Dof>
  using StepperPointer = std::unique_ptr<AnyStepper<Dof>>;

  virtual ~Integrator() = default;
  /// Claims nothing through impacts.
  virtual Facts facts() const = 0;
  /// Of an explicit Runge-Kutta method its a_ij by rows and b as the last row; of others nothing.
  virtual Eigen::MatrixXd coefficients() const { return {}; }
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
