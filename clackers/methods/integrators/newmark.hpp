#pragma once

#include <string_view>
#include <vector>

#include "clackers/base/check.hpp"
#include "clackers/methods/integrators/motion_equation.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"

namespace clackers::methods {

/// Newmark's one-step family for M a + C v + K u + p(u, v) = f(t):
///
///     u1 = u0 + h v0 + h² [(1/2 - beta) a0 + beta a1]
///     v1 = v0 + h [(1 - gamma) a0 + gamma a1]
///     M a1 + C v1 + K u1 + p(u1, v1) = f(t0 + h)
///
/// beta = 1/4: average acceleration, 1/6: linear acceleration, 1/12: Fox-Goodwin, 0: central
/// difference. With p the last line is solved by Newton's iteration down to rounding.
///
/// Order       2 for gamma = 1/2, otherwise 1.
/// Stability   for every h if 2 beta >= gamma >= 1/2; otherwise omega h <= (gamma/2 - beta)^(-1/2).
/// Dissipation none for gamma = 1/2, C = 0; grows with gamma.
/// Memory      a0, taken from the last step; computed anew by restart().
/// Cost        one back-substitution a step; one factorization for each (system, h).
/// Source      N. M. Newmark, J. Eng. Mech. Div. ASCE 85 (EM3), 67-94 (1959).
struct Newmark {
  static constexpr std::string_view name = "newmark";
  static constexpr std::string_view summary =
      "Newmark's one-step family; average acceleration by default";
  static const std::vector<Field<Newmark>>& fields();

  double beta = 0.25;  ///< in [0, 1/2]
  double gamma = 0.5;  ///< in [1/2, 1]; below 1/2 the method is unstable for every h

  /// Throws InputError for parameters outside the ranges above.
  void validate() const;
  Facts facts() const;

  template <int Dof>
  class Stepper;
};

/// One trajectory under Newmark's method. After construction nothing is allocated.
template <int Dof>
class Newmark::Stepper {
 public:
  using State = model::State<Dof>;
  using Vector = model::Vector<Dof>;

  /// The system must outlive the stepper. Throws InputError unless 0 < h < infinity, and for a
  /// system whose effective mass at h is not positive definite; `who` opens its message.
  Stepper(const Newmark& method, const model::SmoothSystem<Dof>& system, double h,
          std::string_view who = Newmark::name)
      : p_(method),
        who_(who),
        h_(require_step(who, h)),
        equation_(system),
        a_(Vector::Zero(system.dof())),
        last_a_(a_),
        part_a_(a_) {
    rebuild();
  }

  /// Takes in changed matrices of the system.
  void rebuild() {
    equation_.rebuild();
    equation_.factorize(weights(h_), whole_);
    require_definite(who_, h_, equation_.failed());
  }

  /// Starts at `from`, or starts again after a jump in velocity: the remembered acceleration no
  /// longer holds.
  void restart(const State& from) {
    equation_.accelerate(from.t, from.u, from.v, a_);
    start_ = from.t;
    steps_ = 0;
  }

  /// Moves `now` from t to t + h.
  void step(State& now) {
    last_a_ = a_;
    advance(now, a_, h_, whole_);
    now.t = start_ + double(++steps_) * h_;  // a sum of h would drift
  }

  /// Takes the last step() back, once: the next step or partial step is from the state before it.
  void undo() {
    a_ = last_a_;
    --steps_;
  }

  /// The state s after `from`, 0 < s <= h; `from` is the state before the next step(). Valid until
  /// the next call. For locating impacts.
  const State& partial(const State& from, double s) {
    to_ = from;
    part_a_ = a_;
    equation_.factorize(weights(s), part_);
    advance(to_, part_a_, s, part_);
    return to_;
  }

  /// True after a step whose equations could not be solved; its state is meaningless.
  bool failed() const { return equation_.failed(); }
  Code failure() const { return equation_.failure(); }
  /// Forgets failures and counts, for a new run.
  void reset() { equation_.reset(); }
  void add_work(model::Work& work) const { equation_.add_work(work); }

 private:
  using Equation = MotionEquation<Dof>;

  typename Equation::Weights weights(double h) const {
    return {1.0, h * p_.gamma, h * h * p_.beta};
  }

  void advance(State& x, Vector& a, double h, const typename Equation::Solver& effective_mass) {
    // Predictors: the part of the new u and v that does not need the new acceleration.
    x.u += h * x.v + h * h * (0.5 - p_.beta) * a;
    x.v += h * (1.0 - p_.gamma) * a;
    x.t += h;
    // Equation of motion at the new time, solved for the new acceleration.
    equation_.solve(x.t, weights(h), effective_mass, x.u, x.v, a);
    x.u += h * h * p_.beta * a;
    x.v += h * p_.gamma * a;
  }

  Newmark p_;
  std::string_view who_;
  double h_, start_ = 0.0;
  Equation equation_;
  typename Equation::Solver whole_, part_;
  Vector a_, last_a_, part_a_;
  State to_;
  long long steps_ = 0;
};

}  // namespace clackers::methods
