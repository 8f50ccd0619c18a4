#pragma once

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "clackers/base/codes.hpp"
#include "clackers/base/judgement.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/run.hpp"

namespace clackers::methods {

/// Linear motion on which every step is exact to rounding: of any mass that nothing accelerates, or under
/// a constant force alone; of any system without load, or under a constant one.
enum class ExactUnder { no_force, constant_force, no_load, constant_load };

/// A card as data: what the tests measure and the verdict compares with.
struct Facts {
  std::string name{};           ///< the specification: "generalized-alpha:rho=0.8+event-driven"
  double smooth_order = 0.0;    ///< of u and v while nothing collides
  double dense_order = 0.0;     ///< of the output inside a step; 0: that of a step of its own
  bool is_adaptive = false;     ///< chooses its steps by a tolerance
  bool is_linear_only = false;  ///< takes no nonlinear force
  /// Largest omega h of undamped smooth motion; may be infinite. 0: it grows in every short step.
  double stability_limit = 0.0;
  /// Spectral radius at infinite omega h; NaN where not every step is stable, or it is not known.
  double radius_at_infinity = std::numeric_limits<double>::quiet_NaN();
  /// The orders are those of other motion. Every method of second order is exact under a constant force.
  ExactUnder exact_under = ExactUnder::no_force;
  Claim through_impacts{};  ///< of an integrator alone: nothing
  /// The order through impacts of restitution 0 after which the contact stays closed; 0: the claimed one.
  double plastic_order = 0.0;
  /// Through impacts, where a constant force presses a contact closed, springs act on it in contact, or
  /// forces are nonlinear: its order is that of an envelope.
  bool scatters_pressed = false;
  bool reports_impacts = true;
  /// Of a compliant contact: the error of its model falls as stiffness^-model_order where it models
  /// the restitution; 0 for rigid contact.
  double model_order = 0.0;

  bool is_unconditionally_stable() const { return std::isinf(stability_limit); }
};

/// What a method claims on a problem: through impacts or, where nothing collides, in smooth motion.
/// `shares_impacts`: contacts that share masses close together. Compliant contacts share such an impact
/// by their stiffnesses, whatever these are: they claim a floor, but not that stiffness lowers it.
/// `opens_at_once`: a contact with restitution 0 does not stay closed after an impact.
Claim claim_on(const Facts& facts, const model::ImpactProblem<>& problem, bool collides,
               bool shares_impacts = false, bool opens_at_once = false);

/// Why a method cannot take a problem.
struct Objection {
  std::string sentence;
  Code code;
};

/// Of a method without a law of friction, to a problem that has it.
inline Objection objection_to_friction(const std::string& who) {
  return {
      who +
          ": the problem has dry friction, for which it has no law. Use event-driven, penalty or "
          "moreau-jean.",
      "linear-only"};
}

/// Of every method, to a problem that rows do not state in full.
inline Objection objection_to_unstated(const std::string& who, const std::string& law) {
  return {
      fmt::format(
          "{}: the problem is not complete: no row states {}. Assess a program by its histories, with check "
          "or verify --exec.",
          who, law),
      "not-stated"};
}

/// What a run is to resolve: a step, or the tolerance of an adaptive method.
struct Resolution {
  double step = std::numeric_limits<double>::quiet_NaN();       ///< [s]
  double tolerance = std::numeric_limits<double>::quiet_NaN();  ///< of a step's relative error

  Resolution(double h) : step(h) {}  // NOLINT(google-explicit-constructor): a step is one
  static Resolution by_tolerance(double tolerance) {
    Resolution resolution(std::numeric_limits<double>::quiet_NaN());
    resolution.tolerance = tolerance;
    return resolution;
  }
  bool is_tolerance() const { return !std::isnan(tolerance); }
};

/// A time-integration method, assessed as a whole: an integrator joined with a contact treatment,
/// or a method that brings its own integration.
class Method {
 public:
  virtual ~Method() = default;
  virtual Facts facts() const = 0;
  /// The sentence that says why it cannot take this problem, or nothing.
  virtual std::optional<Objection> objection(const model::ImpactProblem<>& problem) const = 0;
  /// How long one contact lasts [s] for a compliant contact treatment; 0 for a rigid one. A run
  /// resolves the contact where its step is at most 1/25 of this.
  virtual double contact_time(const model::ImpactProblem<>&) const { return 0.0; }
  /// A name that all methods share whose runs of this problem are the same, to the bit; nothing where it
  /// shares them with none.
  virtual std::string shared_run(const model::ImpactProblem<>&) const { return {}; }
  /// Throws InputError unless 0 < step < infinity [s] (of an adaptive method: unless there is a
  /// tolerance that it takes), the problem is valid and there is no objection. The run copies what
  /// it needs of the problem.
  virtual std::unique_ptr<model::Run> prepare(const model::ImpactProblem<>& problem,
                                              const Resolution& resolution) const = 0;
};

}  // namespace clackers::methods
