#include <algorithm>
#include <cmath>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/position_newmark.hpp"

namespace clackers::methods {

struct AugmentedLagrangian {
  static constexpr std::string_view name = "augmented-lagrangian";
  static constexpr std::string_view summary =
      "average acceleration with the gap closed by Uzawa's iteration; gains energy at impacts";
  static constexpr std::string_view card =
      R"(Newmark's average acceleration with an augmented Lagrangian for the gaps at the end of the step,
iterated by Uzawa's rule from L = 0:

    M a1 + C v1 + K u1 + p(u1, v1) = f(t1) + B^T L
    u1 = u0 + h/2 (v0 + v1),   v1 = v0 + h/2 (a0 + a1)
    L <- max(0, L - eps g(u1))   until |change of L| <= eps tolerance

eps is `factor` over the largest sum of a row of |dg/dL|, so that the iteration converges for every
factor below 2, with 1 at once where one contact is closed. The limit is Newmark's method with a
position multiplier and gains energy at impacts as that one does: no law of restitution. Only
eta = 1 is accepted, which one expects of a method without dissipation.

Order       2 in smooth motion; none through impacts.
Stability   for every h in smooth motion; impacts add energy.
Dissipation none in flight for C = 0.
Memory      a0, contact included.
Rest        none: impacts with eta = 1 do not accumulate.
Cost        one evaluation and one back-substitution a step, and as many again in each iteration;
            one factorization.
Source      J. C. Simo, T. A. Laursen, Comput. Struct. 42, 97-116 (1992).
)";
  static const std::vector<Field<AugmentedLagrangian>>& fields() {
    static const std::vector<Field<AugmentedLagrangian>> all = {
        {"factor", "0 < factor < 2", "penalty over the stiffness that the step gives to a contact",
         &AugmentedLagrangian::factor},
        {"tolerance", "0 < tolerance < infinity", "of the gap in the iteration [m]",
         &AugmentedLagrangian::tolerance}};
    return all;
  }

  double factor = 1.0;       ///< in (0, 2)
  double tolerance = 1e-12;  ///< of the gap [m]; positive

  /// Throws InputError for parameters outside their ranges.
  void validate() const {
    if (!(factor > 0.0 && factor < 2.0))
      refuse(name, "factor", factor, "0 < factor < 2",
             "From 2 on the iteration does not converge.");
    require_positive(name, "tolerance", tolerance);
  }
  Facts facts() const {
    return position_newmark_facts(specification(*this),
                                  {Behaviour::divergent, 0.0, "energy-growth"});
  }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const {
    return position_newmark_objection(specification(*this), problem);
  }

  template <int Dof>
  class Loop;
};

template <int Dof>
class AugmentedLagrangian::Loop final : public PositionNewmark<Dof> {
 public:
  Loop(const AugmentedLagrangian& method, model::ImpactProblem<Dof> problem, const StepPlan& plan)
      : PositionNewmark<Dof>(specification(method), std::move(problem), plan), method_(method) {}

 private:
  using Base = SteppingScheme<Dof>;
  using Base::change_, Base::impulses_, Base::response_, Base::rows_;

  // In terms of impulses h L and of the gap rate 2 g / h.
  void improve_impulses() override {
    const double largest = response_.delassus.cwiseAbs().rowwise().sum().maxCoeff();
    penalty_ = method_.factor / largest;
    for (const auto j : rows_) {
      auto& impulse = impulses_[Eigen::Index(j)];
      impulse = std::max(0.0, impulse - penalty_ * this->excess(j));
    }
  }
  bool is_settled(double h) const override {
    return 0.5 * h * change_.cwiseAbs().maxCoeff() <= method_.tolerance * penalty_;
  }
  int most_iterations() const override { return 10000; }

  AugmentedLagrangian method_;
  double penalty_ = 0.0;
};

template Row row<AugmentedLagrangian>();

}  // namespace clackers::methods
