#pragma once

#include <limits>
#include <string_view>
#include <utility>

#include "clackers/methods/timestepping/stepping_scheme.hpp"

namespace clackers::methods {

/// Central differences with impulses, w_k the velocity between t_k and t_k+1:
///
///     u_k+1 = u_k + h w_k
///     M (w_k+1 - w_k) + h C v_k+1 + h [K u_k+1 + p - f(t_k+1)] = B^T P,   v_k+1 = (w_k + w_k+1) / 2
///
/// kept as v_k and a_k = (w_k - v_k) 2 / h, impulse included. A scheme is its least_rate() of w_k+1. A
/// shorter last step lies on the parabola through the last three displacements.
template <int Dof>
class Leapfrog : public SteppingScheme<Dof> {
 protected:
  using Base = SteppingScheme<Dof>;
  using Base::before_, Base::contacts_, Base::equation_, Base::jump_, Base::x0_, Base::x1_,
      Base::y_;

  Leapfrog(std::string_view name, model::ImpactProblem<Dof> problem, const StepPlan& plan,
           int most_impact_steps)
      : Base(std::move(problem), plan, most_impact_steps),
        name_(name),
        a0_(y_),
        a1_(a0_),
        shift_(a0_) {
    prepare(plan.h);
  }

 private:
  static constexpr auto weights(double h) {
    return typename MotionEquation<Dof>::Weights{1.0, 0.5 * h, 0.0};
  }

  void prepare(double h) final { this->respond(name_, h, weights(h)); }

  void start() final { equation_.accelerate(x0_.t, x0_.u, x0_.v, a0_); }

  void predict(double h) final {
    before_ = x0_.v + 0.5 * h * a0_;
    x1_.u = x0_.u + h * before_;
  }

  void complete(double h) final {
    shift_ = jump_ / -h;
    a1_ = a0_;
    equation_.solve({x1_.t}, weights(h), x1_.u, before_, a1_, &shift_);
    x1_.v = before_ + 0.5 * h * a1_;
    y_ = before_ + h * a1_;
  }

  void accept() final { a0_ = a1_; }

  std::string_view name_;
  model::Vector<Dof> a0_, a1_, shift_;
};

}  // namespace clackers::methods
