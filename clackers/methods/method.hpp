#pragma once

#include <memory>
#include <optional>
#include <string>

#include "clackers/base/codes.hpp"
#include "clackers/base/judgement.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/run.hpp"

namespace clackers::methods {

/// What a method promises of its displacement error through impacts.
using Claim = clackers::Claim;

/// A method's card as data: what the tests measure and the verdict compares with.
struct Facts {
  std::string name;  ///< as typed, with its parameters: "generalized-alpha:rho=0.8+event-driven"
  double smooth_order = 0.0;            ///< of u and v while nothing collides
  bool unconditionally_stable = false;  ///< in smooth motion, for every step
  double stability_limit =
      0.0;  ///< largest omega h of undamped smooth motion; infinity if unconditional
  Claim through_impacts;
  bool reports_impacts = true;
};

/// Why a method cannot take a problem.
struct Objection {
  std::string sentence;
  Code code;
};

/// A time-integration method, judged as a whole: an integrator joined with a contact treatment,
/// a treatment that brings its own integration, or an engine.
class Method {
 public:
  virtual ~Method() = default;
  virtual Facts facts() const = 0;
  /// The sentence that says why it cannot take this problem, or nothing.
  virtual std::optional<Objection> objection(const model::ImpactProblem<>& problem) const = 0;
  /// How long one contact lasts [s] for a compliant contact treatment; 0 for a rigid one. A run
  /// resolves the contact where its step is at most 1/25 of this.
  virtual double contact_time(const model::ImpactProblem<>& problem) const;
  /// Throws InputError unless 0 < step < infinity [s], the problem is valid and there is no
  /// objection. The run copies what it needs of the problem.
  virtual std::unique_ptr<model::Run> prepare(const model::ImpactProblem<>& problem,
                                              double step) const = 0;
};

}  // namespace clackers::methods
