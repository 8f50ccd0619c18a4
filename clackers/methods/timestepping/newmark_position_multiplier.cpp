#include "clackers/methods/timestepping/newmark_position_multiplier.hpp"

#include <utility>

#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/position_newmark.hpp"

namespace clackers::methods {

Facts NewmarkPositionMultiplier::facts() const { return position_newmark_facts(std::string(name)); }

std::optional<Objection> NewmarkPositionMultiplier::objection(
    const model::ImpactProblem<>& problem) const {
  if (auto no = position_newmark_objection(std::string(name), problem)) return no;
  return objection_to_closed_contacts(std::string(name), problem);
}

template <int Dof>
class NewmarkPositionMultiplier::Loop final : public PositionNewmark<Dof> {
 public:
  Loop(const NewmarkPositionMultiplier&, model::ImpactProblem<Dof> problem, const StepPlan& plan)
      : PositionNewmark<Dof>(name, std::move(problem), plan) {}
};

template Row row<NewmarkPositionMultiplier>();

}  // namespace clackers::methods
