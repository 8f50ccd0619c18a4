#include "clackers/methods/timestepping/paoli_schatzman.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/leapfrog.hpp"

namespace clackers::methods {

Facts PaoliSchatzman::facts() const {
  return {.name = std::string(name),
          .smooth_order = 2.0,
          .stability_limit = 2.0,
          .through_impacts = {Behaviour::proper, 1.0, {}}};
}

std::optional<Objection> PaoliSchatzman::objection(const model::ImpactProblem<>& problem) const {
  const auto is_inelastic = [](const auto& contact) { return contact.restitution == 0.0; };
  if (!problem.contacts.empty() && std::ranges::all_of(problem.contacts, is_inelastic))
    return Objection{
        fmt::format("{} with eta = 0: it is then forward-increment-lagrange, of order 2. "
                    "Use that.",
                    name),
        "law-needs-restitution"};
  return objection_to_closed_contacts(std::string(name), problem);
}

template <int Dof>
class PaoliSchatzman::Loop final : public Leapfrog<Dof> {
 public:
  Loop(const PaoliSchatzman&, model::ImpactProblem<Dof> problem, const StepPlan& plan)
      : Leapfrog<Dof>(name, std::move(problem), plan, 2) {}

 private:
  // u2 = u1 + h y and u0 = u1 - h before_.
  double least_rate(std::size_t j, double h) const override {
    const double eta = this->contacts_.restitution(j);
    return eta * this->contacts_.gap_rate(j, this->before_) -
           (1.0 + eta) * this->contacts_.gap(j, this->x1_.u) / h;
  }
};

template Row row<PaoliSchatzman>();

}  // namespace clackers::methods
