#pragma once

#include <optional>
#include <span>
#include <vector>

#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/model/impact_problem.hpp"

namespace clackers::diagnose {

/// What a parameter d of a hypothesis changes; at d = 0 nothing. Masses that are not coupled.
enum class Change {
  frequency,             ///< k times (1 + d)^2
  frequency_at_ratio,    ///< the same, and c times (1 + d): the damping ratio stays
  damping,               ///< damping ratio plus d
  damping_share,         ///< c times (1 + d)
  mass,                  ///< m times (1 + d), k and c stay
  mass_ratio,            ///< m, k and c times (1 + d): only impacts notice it
  restitution,           ///< eta plus d, of all contacts
  gap,                   ///< contacts close d earlier [m], at a gap of d of the case
  impulse,               ///< impulse on the mass times (1 + d)
  time_scale,            ///< time runs (1 + d) times as fast
  time_shift,            ///< rows are late by d seconds
  damping_after_impact,  ///< damping times (1 + d) after the first impact
};

/// A change and the mass that it concerns, -1 for all of them.
struct Parameter {
  Change change = Change::frequency;
  int mass = -1;

  bool operator==(const Parameter&) const = default;
};

/// A changed system, a changed law of impact, and a changed reading of the time of rows.
struct Variation {
  model::ImpactProblem<> problem;
  exact::ImpactLaw law{};
  double time_factor = 1.0, time_shift = 0.0;

  void apply(const Parameter& parameter, double d);
};

/// The displacements at the rows' times `t` (ascending), row-major; rows before the start are NaN.
/// Nothing where the motion is not available. The system has no load.
std::optional<std::vector<double>> simulated(const Variation& variation, std::span<const double> t);

}  // namespace clackers::diagnose
