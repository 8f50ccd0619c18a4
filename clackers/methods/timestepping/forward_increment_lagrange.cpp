#include <fmt/format.h>

#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/leapfrog.hpp"

namespace clackers::methods {

struct ForwardIncrementLagrange {
  static constexpr std::string_view name = "forward-increment-lagrange";
  static constexpr std::string_view summary =
      "central differences with multipliers that close the gap in the next step; for eta = 0";
  static constexpr std::string_view card =
      R"(Forward-increment Lagrange multipliers with central differences: the forces L at t1 are those that
close, at the end of the next step, the contacts that the free motion would penetrate:

    M (u2 - 2 u1 + u0) / h² + C v1 + K u1 + p(u1, v1) = f(t1) + B^T L
    v1 = (u2 - u0) / 2 h
    0 <= b.u2 - gap _|_ L >= 0          at every contact

It has no law of restitution: masses stay together after the contact, which is restitution 0.
With several contacts the signs of L follow from the complementarity and not from iterations over
contacts, and the scheme is that of Paoli and Schatzman for eta = 0. An impact takes two steps; its
impulse is the sum of both h L, reported at the second. A lasting contact is a row of such
impacts.

Order       2 in smooth motion, and in displacement through impacts with eta = 0, since the gap is
            closed at the end of the step of the impact; 1 in velocity there.
Stability   omega h <= 2.
Dissipation none in flight for C = 0.
Memory      u0, kept as acceleration and velocity.
Rest        from the first impact on; the force is reported as an impulse every second step.
Cost        one evaluation and one back-substitution a step, one more in contact with a
            complementarity problem; one factorization.
Source      N. J. Carpenter, R. L. Taylor, M. G. Katona, Int. J. Numer. Methods Eng. 32, 103-128
            (1991).
)";

  Facts facts() const {
    return {.name = std::string(name),
            .smooth_order = 2.0,
            .stability_limit = 2.0,
            .through_impacts = {Behaviour::proper, 2.0, {}}};
  }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const {
    for (const auto& contact : problem.contacts)
      if (contact.restitution != 0.0)
        return Objection{
            fmt::format("{} with eta = {}: its multipliers close the gap and give nothing "
                        "back, which is eta = 0. Use cd-lagrange.",
                        name, contact.restitution),
            "needs-inelastic"};
    return objection_to_closed_contacts(std::string(name), problem);
  }

  template <int Dof>
  class Loop;
};

template <int Dof>
class ForwardIncrementLagrange::Loop final : public Leapfrog<Dof> {
 public:
  Loop(const ForwardIncrementLagrange&, model::ImpactProblem<Dof> problem, const StepPlan& plan)
      : Leapfrog<Dof>(name, std::move(problem), plan, 2) {}

 private:
  double least_rate(std::size_t j, double h) const override {
    return -this->contacts_.gap(j, this->x1_.u) / h;
  }
};

template Row row<ForwardIncrementLagrange>();

}  // namespace clackers::methods
