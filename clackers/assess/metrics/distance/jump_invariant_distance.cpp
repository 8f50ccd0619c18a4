#include "clackers/assess/metrics/distance/jump_invariant_distance.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/assess/errors/mechanics.hpp"
#include "clackers/assess/metrics/metric.hpp"

namespace clackers::assess {
namespace {

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

double distance(const double* one, const double* other, std::span<const double> scale) {
  double largest = 0.0;
  for (std::size_t j = 0; j < scale.size(); ++j)
    largest = std::max(largest, std::abs(one[j] - other[j]) / scale[j]);
  return largest;
}

bool all_positive(std::span<const double> entries) {
  return std::ranges::all_of(entries, [](double entry) { return entry > 0.0; });
}

}  // namespace

MetricValue jump_invariant_distance(const Comparison& comparison) {
  if (!comparison.has_velocities()) return not_measured("The history has no velocities.");
  if (comparison.problem().contacts.empty()) return not_measured("The problem has no contact.");
  const auto u_scale = comparison.u_envelope(), v_scale = comparison.v_envelope();
  if (!all_positive(u_scale) || !all_positive(v_scale))
    return not_measured("A mass of the reference has no extent at t = 0 to divide by.");

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

}  // namespace clackers::assess
