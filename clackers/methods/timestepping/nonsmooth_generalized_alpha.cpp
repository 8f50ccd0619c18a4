#include <limits>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/stepping_scheme.hpp"

namespace clackers::methods {

struct NonsmoothGeneralizedAlpha {
  static constexpr std::string_view name = "nonsmooth-generalized-alpha";
  static constexpr std::string_view summary =
      "generalised-alpha in flight, impulses at the end of the step of an impact";
  static constexpr std::string_view card =
      R"(The nonsmooth generalised-alpha scheme, in its first form with impulses W only at the level of
velocity. s is the acceleration without contact forces, rho the spectral radius at infinite omega h:

    M s1 + C v1 + K u1 + p(u1, v1) = f(t1)
    (1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) s1 + alpha_f s0
    v1 = v0 + h [(1 - gamma) a0 + gamma a1] + W,               M W = B^T P
    u1 = u0 + h v0 + h² [(1/2 - beta) a0 + beta a1] + h/2 W
    0 <= b.v1 + eta b.v0 _|_ P >= 0      where g(u1) <= 0 for W = 0, else P = 0
    alpha_m = (2 rho - 1)/(rho + 1), alpha_f = rho/(rho + 1),
    gamma = 1/2 - alpha_m + alpha_f, beta = (1 - alpha_m + alpha_f)²/4

The gap may stay negative by the motion of one step. Impacts are reported at the end of the step.

Order       2 in smooth motion; 1 of the upper envelope through impacts, errors of neighbouring
            steps scatter.
Stability   for every h.
Dissipation none in flight for rho = 1, C = 0; grows as rho falls, for high frequencies first.
Memory      a0 and s0; both live through an impact.
Rest        accumulating impacts end in a contact that is closed to less than the motion of one step;
            its force is reported as an impulse in each step.
Cost        one evaluation and one back-substitution a step, one more at an impact with its
            complementarity problem; one factorization.
Source      Q.-Z. Chen, V. Acary, G. Virlez, O. Bruls, Int. J. Numer. Methods Eng. 96, 487-511
            (2013).
)";
  static const std::vector<Field<NonsmoothGeneralizedAlpha>>& fields() {
    static const std::vector<Field<NonsmoothGeneralizedAlpha>> all = {
        {"rho", "0 <= rho <= 1", "spectral radius at infinite omega h; 1: no dissipation",
         &NonsmoothGeneralizedAlpha::rho}};
    return all;
  }

  double rho = 0.8;  ///< in [0, 1]; 1 for no dissipation

  /// Throws InputError for rho outside [0, 1].
  void validate() const {
    if (!(rho >= 0.0 && rho <= 1.0)) refuse(name, "rho", rho, "0 <= rho <= 1");
  }
  Facts facts() const {
    return {.name = specification(*this),
            .smooth_order = 2.0,
            .stability_limit = std::numeric_limits<double>::infinity(),
            .radius_at_infinity = rho,
            .through_impacts = {Behaviour::irregular, 1.0, {}}};
  }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const {
    return objection_to_closed_contacts(specification(*this), problem);
  }

  template <int Dof>
  class Loop;
};

template <int Dof>
class NonsmoothGeneralizedAlpha::Loop final : public SteppingScheme<Dof> {
 public:
  Loop(const NonsmoothGeneralizedAlpha& method, model::ImpactProblem<Dof> problem,
       const StepPlan& plan)
      : Base(std::move(problem), plan),
        alpha_m_((2.0 * method.rho - 1.0) / (method.rho + 1.0)),
        alpha_f_(method.rho / (method.rho + 1.0)),
        gamma_(0.5 - alpha_m_ + alpha_f_),
        beta_(0.25 * (1.0 - alpha_m_ + alpha_f_) * (1.0 - alpha_m_ + alpha_f_)),
        who_(specification(method)),
        a0_(x0_.v),
        a1_(a0_),
        s0_(a0_),
        shift_(a0_),
        u_(a0_),
        v_(a0_) {
    prepare(plan.h);
  }

 private:
  using Base = SteppingScheme<Dof>;
  using Base::contacts_, Base::equation_, Base::jump_, Base::response_, Base::x0_, Base::x1_;
  using Base::y_, Base::before_;

  typename MotionEquation<Dof>::Weights weights(double h) const {
    return {inertia(), gamma_ * h, beta_ * h * h};
  }
  double inertia() const { return (1.0 - alpha_m_) / (1.0 - alpha_f_); }

  // v1 changes by A^-1 [inertia M + (beta - gamma/2) h^2 K] W, A the matrix of the weights: symmetric
  // in terms of impulses where damping couples no modes.
  void prepare(double h) override {
    this->respond(who_, h, weights(h));
    if (contacts_.size() == 0) return;
    const auto& s = equation_.system();
    auto& velocity = response_.velocity;
    velocity = (inertia() * s.mass + (beta_ - 0.5 * gamma_) * h * h * s.stiffness) *
               contacts_.response().velocity;
    equation_.factorized(weights(h)).solve_in_place(velocity);
    auto& delassus = response_.delassus;
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      delassus.row(Eigen::Index(i)) = contacts_.row(i).transpose() * velocity;
    delassus = (0.5 * (delassus + delassus.transpose())).eval();
  }

  void start() override {
    equation_.accelerate(x0_.t, x0_.u, x0_.v, a0_);
    s0_ = a0_;
    a1_ = a0_;
  }

  void predict(double h) override {
    before_ = x0_.v;
    u_ = x0_.u + h * x0_.v + (0.5 - beta_) * h * h * a0_;
    v_ = x0_.v + (1.0 - gamma_) * h * a0_;
    shift_ = (alpha_m_ * a0_ - alpha_f_ * s0_) / (1.0 - alpha_f_);
  }

  void complete(double h) override {
    x1_.u = u_ + 0.5 * h * jump_;
    x1_.v = v_ + jump_;
    equation_.solve({x1_.t}, weights(h), x1_.u, x1_.v, a1_, &shift_);
    x1_.u += beta_ * h * h * a1_;
    x1_.v += gamma_ * h * a1_;
    y_ = x1_.v;
  }

  double least_rate(std::size_t j, double) const override {
    if (contacts_.gap(j, x1_.u) > 0.0) return -std::numeric_limits<double>::infinity();
    return -contacts_.restitution(j) * contacts_.gap_rate(j, x0_.v);
  }

  void accept() override {
    s0_ = inertia() * a1_ + shift_;
    a0_ = a1_;
  }

  double alpha_m_, alpha_f_, gamma_, beta_;
  std::string who_;
  model::Vector<Dof> a0_, a1_, s0_, shift_, u_, v_;
};

template Row row<NonsmoothGeneralizedAlpha>();

}  // namespace clackers::methods
