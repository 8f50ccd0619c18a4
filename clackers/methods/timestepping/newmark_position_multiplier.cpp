#include <utility>

#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/position_newmark.hpp"

namespace clackers::methods {

struct NewmarkPositionMultiplier {
  static constexpr std::string_view name = "newmark-position-multiplier";
  static constexpr std::string_view summary =
      "average acceleration with multipliers for the gap; gains energy: a warning";
  static constexpr std::string_view card =
      R"(Newmark's average acceleration with Lagrange multipliers for the gaps at the end of the step:

    M a1 + C v1 + K u1 + p(u1, v1) = f(t1) + B^T L,   0 <= g(u1) _|_ L >= 0
    u1 = u0 + h/2 (v0 + v1),   v1 = v0 + h/2 (a0 + a1)

A warning: not to be used. While L acts, the rule for u1 makes b.v1 = -b.v0 - 2 g(u0) / h, and the
acceleration of the contact, of the size b.v0 / h, enters the next step once more. A mass that
arrives at a stop with velocity -V leaves it with a velocity between V/3 and 3 V that depends on
the position of the impact in the step, however small the step. Average acceleration loses no
energy, so that eta = 1 is what one expects of it; no other eta is accepted.

Order       2 in smooth motion; none through impacts.
Stability   for every h in smooth motion; impacts add energy.
Dissipation none in flight for C = 0; the mean of the logarithm over all positions of the impact in
            the step is a factor 2.1 of the kinetic energy at a stop.
Memory      a0, contact included.
Rest        none: impacts with eta = 1 do not accumulate.
Cost        one evaluation and one back-substitution a step, one more at an impact with its
            complementarity problem; one factorization.
Source      V. Acary, Z. Angew. Math. Mech. 96, 585-603 (2016), on why not.
)";

  Facts facts() const {
    return position_newmark_facts(std::string(name), {Behaviour::divergent, 0.0, "energy-growth"});
  }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const {
    if (auto no = position_newmark_objection(std::string(name), problem)) return no;
    return objection_to_closed_contacts(std::string(name), problem);
  }

  template <int Dof>
  class Loop;
};

template <int Dof>
class NewmarkPositionMultiplier::Loop final : public PositionNewmark<Dof> {
 public:
  Loop(const NewmarkPositionMultiplier&, model::ImpactProblem<Dof> problem, const StepPlan& plan)
      : PositionNewmark<Dof>(name, std::move(problem), plan) {}
};

template Row row<NewmarkPositionMultiplier>();

}  // namespace clackers::methods
