#include "clackers/diagnose/system/variation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/error.hpp"

namespace clackers::diagnose {

namespace {

void change_mass(Variation& variation, Change change, Eigen::Index i, double d) {
  auto& system = variation.problem.system;
  double &m = system.mass(i, i), &c = system.damping(i, i), &k = system.stiffness(i, i);
  switch (change) {
    case Change::frequency_at_ratio:
      c *= 1.0 + d;
      [[fallthrough]];
    case Change::frequency:
      k *= (1.0 + d) * (1.0 + d);
      break;
    case Change::damping:
      c += 2.0 * d * std::sqrt(k * m);
      break;
    case Change::damping_share:
      c *= 1.0 + d;
      break;
    case Change::mass_ratio:
      c *= 1.0 + d;
      k *= 1.0 + d;
      [[fallthrough]];
    case Change::mass:
      m *= 1.0 + d;
      break;
    case Change::impulse: {
      auto& factors = variation.law.impulse_factor;
      factors.resize(std::size_t(system.dof()), 1.0);
      factors[std::size_t(i)] *= 1.0 + d;
      break;
    }
    default:
      break;
  }
}

}  // namespace

void Variation::apply(const Parameter& parameter, double d) {
  switch (parameter.change) {
    case Change::restitution:
      for (auto& contact : problem.contacts) contact.restitution += d;
      return;
    case Change::gap:
      for (auto& contact : problem.contacts) contact.gap += d;
      return;
    case Change::time_scale:
      time_factor *= 1.0 + d;
      return;
    case Change::time_shift:
      time_shift += d;
      return;
    case Change::damping_after_impact:
      law.damping_after_impact *= 1.0 + d;
      return;
    default:
      break;
  }
  for (Eigen::Index i = 0; i < problem.dof(); ++i)
    if (parameter.mass < 0 || parameter.mass == int(i)) change_mass(*this, parameter.change, i, d);
}

std::optional<std::vector<double>> simulated(const Variation& variation,
                                             std::span<const double> t) {
  const double start = variation.problem.start.t;
  std::vector<double> times(t.begin(), t.end());
  double last = start;
  for (double& one : times) {
    one = (one - variation.time_shift) * variation.time_factor;
    if (!std::isfinite(one)) return std::nullopt;
    last = std::max(last, one);
  }
  std::optional<exact::PiecewiseMotion> motion;
  try {
    motion.emplace(variation.problem, variation.law, last, 3000);
  } catch (const InputError&) {
    return std::nullopt;
  }
  const auto n = std::size_t(variation.problem.dof());
  // Rows less than a rounding before the start are at the start.
  const double rounding = 1e-9 * (last - start);
  std::size_t before = 0;
  while (before < times.size() && times[before] < start - rounding) ++before;
  for (std::size_t i = before; i < times.size(); ++i) times[i] = std::max(times[i], start);
  std::vector<double> u(times.size() * n, std::numeric_limits<double>::quiet_NaN()), v(u.size());
  motion->sample(std::span(times).subspan(before), model::Side::right,
                 {std::span(u).subspan(before * n), std::span(v).subspan(before * n), {}});
  return u;
}

}  // namespace clackers::diagnose
