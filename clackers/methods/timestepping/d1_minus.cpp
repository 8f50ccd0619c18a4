#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/stepping_scheme.hpp"

namespace clackers::methods {

struct D1Minus {
  static constexpr std::string_view name = "d1-minus";
  static constexpr std::string_view summary =
      "half-explicit time-discontinuous Galerkin scheme, impulses at the end of the step";
  static constexpr std::string_view card =
      R"(The half-explicit time-discontinuous Galerkin scheme D1-minus, F = f(t) - C v - K u - p(u, v):

    V  = v0 + h M^-1 (F0 + B^T p0)
    u1 = u0 + h/2 (v0 + V)
    v- = v0 + h/2 M^-1 [F0 + B^T p0 + F(t1, u1, V) + B^T p1]
    v1 = v- + M^-1 B^T P
    0 <= b.M^-1 (F + B^T p) _|_ p >= 0   p0 where g(u0) <= 0 and b.v0 = 0,
                                         p1 where p0 > 0
    0 <= b.v1 + eta b.v- _|_ P >= 0      at others with g(u1) <= 0

The gap stays negative by the motion since the impact. Impacts are reported at the end of the step.

Order       2 in smooth motion; 1 of the upper envelope through impacts, errors of neighbouring
            steps scatter.
Stability   omega h <= 2 for C = 0, less with damping, which is explicit.
Dissipation none in flight for C = 0.
Memory      none.
Rest        with eta > 0 a pressed contact has an impact in each step and sinks with the speed
            (1 - eta)/(1 + eta) A h/2, A the acceleration that presses it; with eta = 0 p holds it,
            which is not reported.
Cost        two evaluations a step; an impact or a closed contact a complementarity problem.
Source      T. Schindler, V. Acary, Math. Comput. Simul. 95, 180-199 (2014); T. Schindler et al.,
            Comput. Methods Appl. Mech. Eng. 290, 250-276 (2015).
)";

  Facts facts() const {
    return {.name = std::string(name),
            .smooth_order = 2.0,
            .stability_limit = 2.0,
            .through_impacts = {Behaviour::irregular, 1.0, {}}};
  }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const {
    return objection_to_closed_contacts(std::string(name), problem);
  }

  template <int Dof>
  class Loop;
};

template <int Dof>
class D1Minus::Loop final : public SteppingScheme<Dof> {
 public:
  Loop(const D1Minus&, model::ImpactProblem<Dof> problem, const StepPlan& plan)
      : Base(std::move(problem), plan),
        a0_(x0_.v),
        a1_(a0_),
        v_(a0_),
        q_(impulses_),
        force_(impulses_) {
    closed_.reserve(contacts_.size());
  }

 private:
  using Base = SteppingScheme<Dof>;
  using Base::before_, Base::contacts_, Base::equation_, Base::failure_, Base::impulses_,
      Base::jump_;
  using Base::x0_, Base::x1_, Base::y_;

  void prepare(double) override {}  // the response is that of the mass matrix
  void start() override {}

  void predict(double h) override {
    closed_.clear();
    for (std::size_t j = 0; j < contacts_.size(); ++j)
      if (is_closed(j, x0_)) closed_.push_back(j);
    equation_.accelerate(x0_.t, x0_.u, x0_.v, a0_);
    support(a0_);
    std::erase_if(closed_, [this](std::size_t j) { return !(force_[Eigen::Index(j)] > 0.0); });
    v_ = x0_.v + h * a0_;
    x1_.u = x0_.u + 0.5 * h * (x0_.v + v_);
    equation_.accelerate(x1_.t, x1_.u, v_, a1_);
    support(a1_);
    before_ = x0_.v + 0.5 * h * (a0_ + a1_);
  }

  void complete(double) override { x1_.v = y_ = before_ + jump_; }

  double least_rate(std::size_t j, double) const override {
    if (contacts_.gap(j, x1_.u) > 0.0 || std::ranges::count(closed_, j) > 0)
      return -std::numeric_limits<double>::infinity();
    return -contacts_.restitution(j) * contacts_.gap_rate(j, before_);
  }

  void accept() override {}

  bool is_closed(std::size_t j, const model::State<Dof>& x) const {
    return contacts_.gap(j, x.u) <= contacts_.rounding(j, x.u) &&
           std::abs(contacts_.gap_rate(j, x.v)) <= contacts_.rate_rounding(j, x.v);
  }

  // Adds the forces that keep the closed contacts from closing to the acceleration.
  void support(model::Vector<Dof>& a) {
    if (closed_.empty()) return;
    for (const auto j : closed_) q_[Eigen::Index(j)] = contacts_.gap_rate(j, a);
    failure_ = contacts_.solve(contacts_.response(), closed_, q_, force_);
    a.noalias() += contacts_.response().velocity * force_;
  }

  model::Vector<Dof> a0_, a1_, v_;
  std::vector<std::size_t> closed_;  // contacts with a force, ascending
  Eigen::VectorXd q_, force_;        // [m/s^2], [N]
};

template Row row<D1Minus>();

}  // namespace clackers::methods
