#include "clackers/measure/metrics/definitions.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/measure/errors/meter.hpp"

namespace clackers::measure {

MetricValue energy_error(const Comparison& comparison, Energy energy) {
  const auto& system = comparison.problem().system;
  const double potential = MechanicalEnergy(system).potential(comparison.reference_u().data());
  if (std::isnan(potential))
    return not_measured("The structure has a nonlinear force, whose potential is not known.");
  if (energy != Energy::potential && !comparison.has_velocities())
    return not_measured(Comparison::no_velocities);
  const double scale = comparison.meter().scales().energy;
  if (!(scale > 0.0)) return not_measured("The reference has no energy.");
  if (energy == Energy::total) return measured(comparison.meter().score().energy_error);

  const MechanicalEnergy of(system);
  const auto& history = comparison.history();
  const auto dof = comparison.dof();
  double worst = 0.0;
  for (std::size_t i = 0; i < history.u.size(); i += dof) {
    const double error =
        energy == Energy::potential
            ? of.potential(&history.u[i]) - of.potential(&comparison.reference_u()[i])
            : of.kinetic(&history.v[i]) - of.kinetic(&comparison.reference_v()[i]);
    worst = std::max(worst, std::abs(error));
  }
  return measured(worst / scale);
}

MetricValue momentum_error(const Comparison& comparison) {
  if (!comparison.has_velocities()) return not_measured(Comparison::no_velocities);
  const auto& mass = comparison.problem().system.mass;
  const Eigen::VectorXd columns = mass.colwise().sum();
  const auto dof = comparison.dof();
  double scale = 0.0;
  for (std::size_t j = 0; j < dof; ++j)
    scale += mass.col(Eigen::Index(j)).cwiseAbs().sum() * comparison.v_envelope()[j];
  if (!(scale > 0.0))
    return not_measured("The true velocities have no extent, so nothing is relative to them.");

  const auto& v = comparison.history().v;
  const auto v_reference = comparison.reference_v();
  double worst = 0.0;
  for (std::size_t i = 0; i < v.size(); i += dof) {
    double error = 0.0;
    for (std::size_t j = 0; j < dof; ++j)
      error += columns[Eigen::Index(j)] * (v[i + j] - v_reference[i + j]);
    worst = std::max(worst, std::abs(error));
  }
  return measured(worst / scale);
}

MetricValue penetration(const Comparison& comparison) {
  if (comparison.problem().contacts.empty()) return not_measured("The problem has no contact.");
  const auto& u = comparison.history().u;
  const auto dof = comparison.dof();
  double deepest = 0.0;
  for (const auto& contact : comparison.problem().contacts)
    for (std::size_t i = 0; i < u.size(); i += dof) {
      double gap = -contact.gap;
      for (std::size_t j = 0; j < dof; ++j) gap += contact.direction[Eigen::Index(j)] * u[i + j];
      deepest = std::max(deepest, -gap);
    }
  return measured(deepest);
}

// In the earlier half impacts that are late, or the last of many, may still come.
MetricValue rest_error(const Comparison& comparison, Rest rest) {
  if (rest == Rest::speed && !comparison.has_velocities())
    return not_measured(Comparison::no_velocities);
  const auto& history = comparison.history();
  const auto dof = Eigen::Index(comparison.dof());
  double worst = 0.0;
  bool any = false;
  for (const auto& closed : comparison.reference().closed_contacts()) {
    const auto& contact = comparison.problem().contacts[std::size_t(closed.contact)];
    const double from = 0.5 * (closed.from + closed.until);
    const auto first = std::ranges::lower_bound(history.t, from) - history.t.begin(),
               last = std::ranges::upper_bound(history.t, closed.until) - history.t.begin();
    for (auto i = first; i < last; ++i) {
      const auto row = [&](const std::vector<double>& values) {
        return Eigen::Map<const Eigen::VectorXd>(&values[std::size_t(i * dof)], dof);
      };
      const double size =
          rest == Rest::gap ? contact.gap_at(row(history.u)) : contact.gap_rate(row(history.v));
      worst = std::max(worst, std::abs(size));
      any = true;
    }
  }
  return any ? measured(worst) : not_measured("No contact stays closed.");
}

}  // namespace clackers::measure
