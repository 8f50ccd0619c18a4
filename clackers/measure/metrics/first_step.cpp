#include <algorithm>
#include <cmath>

#include "clackers/measure/metrics/definitions.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::measure {
namespace {

// Ascending.
std::vector<double> restitutions(const Comparison& comparison) {
  std::vector<double> found;
  for (const auto& impact : comparison.impacts()) {
    if (impact.v_before.empty() || impact.v_after.empty()) continue;
    const auto& b = comparison.problem().contacts[std::size_t(impact.contact)].direction;
    double before = 0.0, after = 0.0;
    for (Eigen::Index i = 0; i < b.size(); ++i) {
      before += b[i] * impact.v_before[std::size_t(i)];
      after += b[i] * impact.v_after[std::size_t(i)];
    }
    if (before < 0.0) found.push_back(-after / before);
  }
  std::ranges::sort(found);
  return found;
}

MetricValue restitution(const Comparison& comparison, double place) {
  const auto found = restitutions(comparison);
  if (found.empty()) return not_measured("No impact is known with its velocities on both sides.");
  return measured(found[std::size_t(place * double(found.size() - 1))]);
}

}  // namespace

MetricValue restitution_median(const Comparison& comparison) {
  return restitution(comparison, 0.5);
}

MetricValue restitution_smallest(const Comparison& comparison) {
  return restitution(comparison, 0.0);
}

MetricValue first_force_share(const Comparison& comparison) {
  if (!comparison.has_velocities()) return not_measured(Comparison::no_velocities);
  const auto& problem = comparison.problem();
  const auto& history = comparison.history();
  const auto n = Eigen::Index(comparison.dof());
  const auto vector = [&](const std::vector<double>& rows, Eigen::Index row) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(rows.data() + row * n, n));
  };
  const Eigen::VectorXd u = vector(history.u, 0), v = vector(history.v, 0),
                        moved = vector(history.u, 1) - u;
  for (const auto& contact : problem.contacts)
    for (const auto& at : {u, Eigen::VectorXd(u + moved)})
      if (!(contact.direction.dot(at) > contact.gap))
        return not_measured("A contact is closed in the first step.");
  const auto& system = problem.system;
  if (system.add_load || system.nonlinear != nullptr)
    return not_measured("Loads and nonlinear forces are left out.");
  const Eigen::VectorXd a =
      numerics::solved(system.mass, -system.stiffness * u - system.damping * v).col(0);
  const double h = history.t[1] - history.t[0], size = a.dot(system.mass * a);
  if (!(h > 0.0 && size > 0.0)) return not_measured("No force acts at the first row.");
  return measured(a.dot(system.mass * (moved - h * v)) / (h * h * size));
}

}  // namespace clackers::measure
