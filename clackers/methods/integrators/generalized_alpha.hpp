#pragma once

#include <string_view>
#include <vector>

#include "clackers/base/check.hpp"
#include "clackers/methods/integrators/motion_equation.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"

namespace clackers::methods {

/// Generalised-alpha, in the convention of Chung and Hulbert, with rho the spectral radius at
/// infinite omega h, x_m = (1 - alpha_f) x1 + alpha_f x0 for x = u, v, t:
///
///     M [(1 - alpha_m) a1 + alpha_m a0] + C v_m + K u_m + p(u_m, v_m) = f(t_m)
///     u1 = u0 + h v0 + h² [(1/2 - beta) a0 + beta a1]
///     v1 = v0 + h [(1 - gamma) a0 + gamma a1]
///     alpha_m = (2 rho - 1)/(rho + 1), alpha_f = rho/(rho + 1),
///     gamma = 1/2 - alpha_m + alpha_f, beta = (1 - alpha_m + alpha_f)²/4
///
/// Order       2 in u and v; the stored a is of order 1 at t, of order 2 at
///             t + (alpha_m - alpha_f) h.
/// Stability   for every h.
/// Dissipation none for rho = 1, C = 0; grows as rho falls, for high frequencies first.
/// Memory      a0, taken from the last step; computed anew from equilibrium by restart().
/// Cost        one back-substitution a step; one factorization for each (system, h).
/// Source      J. Chung, G. M. Hulbert, J. Appl. Mech. 60, 371-375 (1993).
struct GeneralizedAlpha {
  static constexpr std::string_view name = "generalized-alpha";
  static constexpr std::string_view summary =
      "generalised-alpha of Chung and Hulbert, dissipation of high frequencies set by rho";
  static const std::vector<Field<GeneralizedAlpha>>& fields();

  double rho = 1.0;  ///< spectral radius at infinite omega h, in [0, 1]

  double alpha_m() const { return (2.0 * rho - 1.0) / (rho + 1.0); }
  double alpha_f() const { return rho / (rho + 1.0); }
  double gamma() const { return 0.5 - alpha_m() + alpha_f(); }
  double beta() const {
    return 0.25 * (1.0 - alpha_m() + alpha_f()) * (1.0 - alpha_m() + alpha_f());
  }

  /// Throws InputError for rho outside [0, 1].
  void validate() const;
  Facts facts() const;

  template <int Dof>
  class Stepper;
};

/// One trajectory under generalised-alpha. After construction nothing is allocated.
template <int Dof>
class GeneralizedAlpha::Stepper {
 public:
  using State = model::State<Dof>;
  using Vector = model::Vector<Dof>;

  /// The system must outlive the stepper. Throws InputError unless 0 < h < infinity, and for a
  /// system whose effective mass at h is not positive definite.
  Stepper(const GeneralizedAlpha& method, const model::SmoothSystem<Dof>& system, double h)
      : am_(method.alpha_m()),
        af_(method.alpha_f()),
        beta_(method.beta()),
        gamma_(method.gamma()),
        h_(require_step("generalized-alpha", h)),
        equation_(system),
        a_(Vector::Zero(system.dof())),
        last_a_(a_),
        part_a_(a_),
        shift_(a_),
        u_m_(a_),
        v_m_(a_) {
    rebuild();
  }

  /// Takes in changed matrices of the system.
  void rebuild() {
    equation_.rebuild();
    equation_.factorize(weights(h_), whole_);
    require_definite("generalized-alpha", h_, equation_.failed());
  }

  /// Starts at `from`, or starts again after a jump in velocity: the remembered acceleration no
  /// longer holds. That a0 belongs to t0 and not to the shifted time costs h² in v once, not a step.
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
    return {1.0 - am_, (1.0 - af_) * h * gamma_, (1.0 - af_) * h * h * beta_};
  }

  void advance(State& x, Vector& a, double h, const typename Equation::Solver& effective_mass) {
    // x_m without the new acceleration: x0 plus (1 - alpha_f) of what the predictor adds to it.
    u_m_ = x.u + (1.0 - af_) * (h * x.v + h * h * (0.5 - beta_) * a);
    v_m_ = x.v + (1.0 - af_) * h * (1.0 - gamma_) * a;
    shift_ = am_ * a;
    x.u += h * x.v + h * h * (0.5 - beta_) * a;
    x.v += h * (1.0 - gamma_) * a;
    const double t_m = x.t + (1.0 - af_) * h;
    equation_.solve(t_m, weights(h), effective_mass, u_m_, v_m_, a, &shift_);
    x.u += h * h * beta_ * a;
    x.v += h * gamma_ * a;
    x.t += h;
  }

  double am_, af_, beta_, gamma_;
  double h_, start_ = 0.0;
  Equation equation_;
  typename Equation::Solver whole_, part_;
  Vector a_, last_a_, part_a_, shift_, u_m_, v_m_;
  State to_;
  long long steps_ = 0;
};

}  // namespace clackers::methods
