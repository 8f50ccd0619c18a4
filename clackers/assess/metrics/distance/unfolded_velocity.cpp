#include "clackers/assess/metrics/distance/unfolded_velocity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/assess/metrics/metric.hpp"

namespace clackers::assess {
namespace {

// Both limits carry half a unit of 2^-52 of themselves each; 4 covers two such and their sum.
bool reverses_all(const model::MotionImpact& impact) {
  const double size = impact.before.v.cwiseAbs().maxCoeff();
  return (impact.before.v + impact.after.v).cwiseAbs().maxCoeff() <=
         4.0 * std::numeric_limits<double>::epsilon() * size;
}

std::string objection(const Comparison& comparison) {
  if (!comparison.has_velocities()) return "The history has no velocities.";
  const auto& contacts = comparison.problem().contacts;
  if (contacts.size() != 1) return "Unfolding is defined for exactly one contact.";
  if (contacts.front().restitution != 1.0)
    return "Unfolding is defined for elastic impacts, restitution 1.";
  const auto& reference = comparison.reference();
  bool all = reference.impact_count(reference.end()) == 0 || reverses_all(reference.impact(1));
  for (const auto& match : comparison.matches()) all = all && reverses_all(match.reference);
  if (all) return comparison.objection_to_sparse_rows();
  return "Unfolding is defined where an impact reverses every velocity; here some pass.";
}

}  // namespace

MetricValue unfolded_velocity_error(const Comparison& comparison) {
  if (auto reason = objection(comparison); !reason.empty()) return not_measured(std::move(reason));
  const auto& history = comparison.history();
  const auto& reference = comparison.reference();
  const auto dof = comparison.dof();
  const auto known = reference.impact_count(reference.end());
  const auto true_time = [&](long long index) {
    return index < known ? reference.impact(index + 1).t : std::numeric_limits<double>::infinity();
  };
  // A history that starts late has had no impact of its own yet; both count from there.
  const double start = history.t.front();
  long long true_passed = start > 0.0 ? reference.impact_count(start) : 0;
  double next_true = true_time(true_passed);
  std::size_t passed = 0;
  bool same_sign = true;
  std::vector<double> errors(dof);
  for (std::size_t i = 0; i < history.t.size(); ++i) {
    const double t = history.t[i];
    const bool left = comparison.is_left_limit(i);
    const auto is_passed = [&](double impact) { return impact < t || (impact == t && !left); };
    for (; passed < comparison.impacts().size() && is_passed(comparison.impacts()[passed].t);
         ++passed)
      same_sign = !same_sign;
    for (; is_passed(next_true); next_true = true_time(++true_passed)) same_sign = !same_sign;
    for (std::size_t j = 0; j < dof; ++j) {
      const double found = history.v[i * dof + j], exact = comparison.reference_v()[i * dof + j];
      errors[j] = std::max(errors[j], std::abs(same_sign ? found - exact : found + exact));
    }
  }
  return measured(std::move(errors));
}

}  // namespace clackers::assess
