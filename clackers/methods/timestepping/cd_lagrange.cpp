#include "clackers/methods/timestepping/cd_lagrange.hpp"

#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/leapfrog.hpp"

namespace clackers::methods {

Facts CdLagrange::facts() const {
  return {.name = std::string(name),
          .smooth_order = 2.0,
          .stability_limit = 2.0,
          .through_impacts = {Behaviour::irregular, 1.0, {}}};
}

std::optional<Objection> CdLagrange::objection(const model::ImpactProblem<>& problem) const {
  return objection_to_closed_contacts(std::string(name), problem);
}

template <int Dof>
class CdLagrange::Loop final : public Leapfrog<Dof> {
 public:
  Loop(const CdLagrange&, model::ImpactProblem<Dof> problem, const StepPlan& plan)
      : Leapfrog<Dof>(name, std::move(problem), plan, 1) {}

 private:
  double least_rate(std::size_t j, double) const override {
    if (this->contacts_.gap(j, this->x1_.u) > 0.0) return -std::numeric_limits<double>::infinity();
    return -this->contacts_.restitution(j) * this->contacts_.gap_rate(j, this->before_);
  }
};

template Row row<CdLagrange>();

}  // namespace clackers::methods
