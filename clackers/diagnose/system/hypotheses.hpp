#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clackers/diagnose/diagnosis.hpp"
#include "clackers/diagnose/system/variation.hpp"

namespace clackers::diagnose {

/// One way in which a solver may be right for another system: one parameter that is fitted, or a
/// departure that has none.
struct Hypothesis {
  Code code;
  std::optional<Parameter> parameter;  ///< nothing where the law alone departs
  exact::ImpactLaw law{};
  bool no_contact = false;

  /// The problem with the law's departure, before the parameter acts.
  Variation base(const model::ImpactProblem<>& problem) const;
  /// Code, value, unit and the facts that say which mass or impact, for the fitted d.
  Diagnosis diagnosis(const model::ImpactProblem<>& problem, double d, double uncertainty) const;
};

/// One row a parameter that the problem has.
std::vector<Hypothesis> parameter_hypotheses(const model::ImpactProblem<>& problem);
/// Missed and doubled impacts first..last, and no contact at all.
std::vector<Hypothesis> impact_hypotheses(int first, int last);
/// Frequency and damping of each mass, and the ratio of masses at impacts: what a method's own error
/// changes.
std::vector<Parameter> smooth_parameters(const model::ImpactProblem<>& problem);
/// The hypothesis that one of these, or the restitution, is another one.
Hypothesis hypothesis_of(const Parameter& parameter);

/// Whether one of these explains nothing that the other does not: no evidence against it.
bool equivalent(const Hypothesis& one, const Hypothesis& other, Eigen::Index dof);

}  // namespace clackers::diagnose
