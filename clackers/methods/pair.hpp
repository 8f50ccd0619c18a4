#pragma once

#include <optional>
#include <string>
#include <utility>

#include "clackers/methods/integrators/integrator_facts.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"
#include "clackers/methods/recorder.hpp"
#include "clackers/methods/step_plan.hpp"

namespace clackers::methods {

/// An integrator joined with a contact treatment: a scheme. What the pair should do through impacts
/// is computed by the treatment from the integrator's facts.
template <class Integrator, class Treatment>
struct Pair {
  Integrator integrator;
  Treatment treatment;

  std::string name() const { return spelled(integrator) + '+' + spelled(treatment); }

  Facts facts() const {
    const IntegratorFacts smooth = integrator.facts();
    return {name(),
            smooth.order,
            smooth.unconditionally_stable,
            smooth.stability_limit,
            treatment.claim(smooth),
            true};
  }

  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const {
    return treatment.objection(name(), problem);
  }

  double contact_time(const model::ImpactProblem<>& problem) const {
    return treatment.contact_time(problem);
  }

  template <int Dof>
  struct TimeLoop : Treatment::template TimeLoop<Integrator, Dof> {
    TimeLoop(const Pair& pair, model::ImpactProblem<Dof> problem, const StepPlan& plan)
        : Treatment::template TimeLoop<Integrator, Dof>(pair.integrator, pair.treatment,
                                                        std::move(problem), plan) {}
  };
};

}  // namespace clackers::methods
