#pragma once

#include <memory>
#include <optional>
#include <string>

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

}  // namespace clackers::methods
