#include "clackers/methods/timestepping/forward_increment_lagrange.hpp"

#include <fmt/format.h>

#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/leapfrog.hpp"

namespace clackers::methods {

Facts ForwardIncrementLagrange::facts() const {
  return {.name = std::string(name),
          .smooth_order = 2.0,
          .stability_limit = 2.0,
          .through_impacts = {Behaviour::proper, 2.0, {}}};
}

std::optional<Objection> ForwardIncrementLagrange::objection(
    const model::ImpactProblem<>& problem) const {
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
