#include "clackers/assess/metrics/energy_error.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/assess/errors/mechanical_energy.hpp"
#include "clackers/assess/metrics/value.hpp"

namespace clackers::assess {

MetricValue energy_error(const Comparison& comparison, Energy energy) {
  const auto& system = comparison.problem().system;
  if (system.nonlinear)
    return not_measured("The structure has a nonlinear force, whose potential is not known.");
  if (energy != Energy::potential && !comparison.has_velocities())
    return not_measured("The history has no velocities.");
  const MechanicalEnergy of(system);
  const auto start = comparison.reference().at(0.0, model::Side::right);
  const double scale = of.total(start.u.data(), start.v.data());
  if (!(scale > 0.0)) return not_measured("The true motion starts without energy.");

  const auto& history = comparison.history();
  const auto dof = comparison.dof();
  double worst = 0.0;
  for (std::size_t i = 0; i < history.u.size(); i += dof) {
    double error = 0.0;
    if (energy != Energy::kinetic)
      error += of.potential(&history.u[i]) - of.potential(&comparison.true_u()[i]);
    if (energy != Energy::potential)
      error += of.kinetic(&history.v[i]) - of.kinetic(&comparison.true_v()[i]);
    worst = std::max(worst, std::abs(error));
  }
  return measured(worst / scale);
}

}  // namespace clackers::assess
