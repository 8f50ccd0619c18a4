#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "clackers/methods/integrator.hpp"
#include "clackers/methods/treatment.hpp"

namespace clackers::methods {

/// An integrator joined with a contact treatment, which computes the claim through impacts from the
/// integrator's facts.
class JoinedMethod final : public Method {
 public:
  JoinedMethod(std::shared_ptr<const Integrator> integrator,
               std::shared_ptr<const Treatment> treatment)
      : integrator_(std::move(integrator)), treatment_(std::move(treatment)) {}

  Facts facts() const override {
    auto facts = integrator_->facts();
    facts.through_impacts = treatment_->claim(facts);
    facts.model_order = treatment_->model_order();
    facts.name += '+' + treatment_->specification();
    return facts;
  }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const override {
    const auto joined = facts();
    if (joined.is_linear_only && problem.system.nonlinear)
      return Objection{
          joined.name +
              ": the problem has a nonlinear force, and the step is exact for linear ones "
              "alone. Use newmark or rk4.",
          "linear-only"};
    if (auto no = treatment_->objection_to(joined)) return no;
    return treatment_->objection(joined, problem);
  }
  double contact_time(const model::ImpactProblem<>& problem) const override {
    return treatment_->contact_time(problem);
  }
  std::unique_ptr<model::Run> prepare(const model::ImpactProblem<>& problem,
                                      const Resolution& resolution) const override {
    return treatment_->prepare(*this, *integrator_, problem, resolution);
  }

 private:
  std::shared_ptr<const Integrator> integrator_;
  std::shared_ptr<const Treatment> treatment_;
};

}  // namespace clackers::methods
