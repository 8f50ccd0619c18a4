#include "clackers/measure/metrics/definitions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::measure {
namespace {

// Both limits carry half a unit of 2^-52 of themselves each; 4 covers two such and their sum.
bool reverses_all(const model::MotionImpact& impact) {
  const double size = impact.before.v.cwiseAbs().maxCoeff();
  return (impact.before.v + impact.after.v).cwiseAbs().maxCoeff() <=
         4.0 * std::numeric_limits<double>::epsilon() * size;
}

std::string objection_to_unfolding(const Comparison& comparison) {
  if (!comparison.has_velocities()) return Comparison::no_velocities;
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

// Newton's law for one contact, applied to velocities.
class ImpactMap {
 public:
  ImpactMap(const model::Contact<>& contact, const FreeMotion& motion)
      : direction_(contact.direction), change_(motion.response(contact.direction)) {
    change_ *= -(1.0 + contact.restitution) / contact.direction.dot(change_);
  }

  void apply(const double* v, std::vector<double>& to) const {
    double rate = 0.0;
    for (std::size_t j = 0; j < to.size(); ++j) rate += direction_[Eigen::Index(j)] * v[j];
    for (std::size_t j = 0; j < to.size(); ++j) to[j] = v[j] + rate * change_[Eigen::Index(j)];
  }

 private:
  Eigen::VectorXd direction_, change_;
};

double distance(const double* first, const double* other, std::span<const double> scale) {
  double largest = 0.0;
  for (std::size_t j = 0; j < scale.size(); ++j)
    largest = std::max(largest, std::abs(first[j] - other[j]) / scale[j]);
  return largest;
}

bool all_positive(std::span<const double> entries) {
  return std::ranges::all_of(entries, [](double entry) { return entry > 0.0; });
}

}  // namespace

MetricValue unfolded_velocity_error(const Comparison& comparison) {
  if (auto reason = objection_to_unfolding(comparison); !reason.empty())
    return not_measured(std::move(reason));
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

MetricValue jump_invariant_distance(const Comparison& comparison) {
  if (!comparison.has_velocities()) return not_measured(Comparison::no_velocities);
  if (comparison.problem().contacts.empty()) return not_measured("The problem has no contact.");
  const auto u_scale = comparison.u_envelope(), v_scale = comparison.v_envelope();
  if (!all_positive(u_scale) || !all_positive(v_scale))
    return not_measured("A mass of the reference has no extent to divide by.");

  const FreeMotion motion(comparison.problem().system);
  std::vector<ImpactMap> maps;
  for (const auto& contact : comparison.problem().contacts) maps.emplace_back(contact, motion);
  const auto& history = comparison.history();
  const auto dof = comparison.dof();
  std::vector<double> image(dof);
  double worst = 0.0;
  for (std::size_t i = 0; i < history.u.size(); i += dof) {
    const double* v = &history.v[i];
    const double* v_reference = &comparison.reference_v()[i];
    const double apart = distance(&history.u[i], &comparison.reference_u()[i], u_scale);
    double least = distance(v, v_reference, v_scale);
    if (std::max(apart, least) <= worst) continue;  // a map could only make it less
    for (const auto& map : maps) {
      map.apply(v, image);
      least = std::min(least, distance(image.data(), v_reference, v_scale));
      map.apply(v_reference, image);
      least = std::min(least, distance(v, image.data(), v_scale));
    }
    worst = std::max(worst, std::max(apart, least));
  }
  return measured(worst);
}

}  // namespace clackers::measure
