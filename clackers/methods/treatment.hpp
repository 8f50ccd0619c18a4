#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "clackers/methods/integrator.hpp"
#include "clackers/methods/method.hpp"

namespace clackers::methods {

/// A contact treatment with its parameters: how a run of an integrator meets contacts.
class Treatment {
 public:
  virtual ~Treatment() = default;
  /// Name and parameters, "penalty:stiffness=1000000".
  virtual std::string specification() const = 0;
  /// What it claims through impacts with an integrator.
  virtual Claim claim(const Facts& integrator) const = 0;
  /// See Facts; 0 for rigid contact.
  virtual double model_order() const { return 0.0; }
  /// Why it cannot drive an integrator, whatever the problem; nothing for most. `method` see
  /// objection().
  virtual std::optional<Objection> objection_to(const Facts& method) const = 0;
  /// See Method. `method` are the facts of the integrator joined with this; its name opens the
  /// sentence.
  virtual std::optional<Objection> objection(const Facts& method,
                                             const model::ImpactProblem<>& problem) const = 0;
  virtual double contact_time(const model::ImpactProblem<>& problem) const = 0;
  /// Method::prepare() of `method`, which joins it with the integrator.
  virtual std::unique_ptr<model::Run> prepare(const Method& method, const Integrator& integrator,
                                              const model::ImpactProblem<>& problem,
                                              const Resolution& resolution) const = 0;
};

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
              "only. Use newmark or rk4.",
          "linear-only"};
    if (auto no = treatment_->objection_to(joined)) return no;
    return treatment_->objection(joined, problem);
  }
  double contact_time(const model::ImpactProblem<>& problem) const override {
    return treatment_->contact_time(problem);
  }
  /// Without contacts and friction a treatment has nothing to treat.
  std::string shared_run(const model::ImpactProblem<>& problem) const override {
    return problem.contacts.empty() && problem.frictions.empty() ? integrator_->facts().name : "";
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
