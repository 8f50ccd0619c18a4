#include "clackers/exact/orbit/flights.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::exact {

using model::Kinematics;
using model::Side;

long long Flights::flight_at(double t, Side side) const {
  model::require_inside("motion", t, end());
  const auto begun = [&](long long k) {
    const double start = instant(k).nearest();
    return start < t || (start == t && side == Side::right);
  };
  auto k = std::max(0LL, near_flight(t));
  while (k > 0 && !begun(k)) --k;
  while (begun(k + 1)) ++k;
  return k;
}

Flights::States Flights::at_time(double t, Side side) const {
  const auto k = flight_at(t, side);
  auto now = state(k, since(k, t));
  // A start that may be at rest is.
  if (t == 0.0)
    for (auto& mass : now)
      if (std::abs(mass.v.value) <= mass.v.error) mass.v = {0.0L, 2.0L * mass.v.error};
  return now;
}

void Flights::sample(std::span<const double> times, Side side, model::SampleBuffers out) const {
  const auto n = std::size_t(dof());
  model::require_buffers("motion", out, times.size(), n);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto now = at_time(times[i], side);
    for (std::size_t j = 0; j < n; ++j) {
      out.u[n * i + j] = now[j].u.nearest();
      out.v[n * i + j] = now[j].v.nearest();
      if (!out.a.empty()) out.a[n * i + j] = now[j].a.nearest();
    }
  }
}

Kinematics Flights::error_bound(double t) const {
  const auto zero = Eigen::VectorXd::Zero(dof());
  Kinematics bound{zero, zero, zero};
  for (const auto side : {Side::left, Side::right}) {
    const auto now = at_time(t, side);
    for (Eigen::Index j = 0; j < dof(); ++j) {
      const auto& mass = now[std::size_t(j)];
      bound.u[j] = std::max(bound.u[j], mass.u.nearest_error());
      bound.v[j] = std::max(bound.v[j], mass.v.nearest_error());
      bound.a[j] = std::max(bound.a[j], mass.a.nearest_error());
    }
  }
  return bound;
}

long long Flights::impact_count(double t) const {
  auto k = flight_at(t, Side::right);
  if (k > 0 && instant(k).value > static_cast<long double>(t)) --k;
  return k;
}

model::MotionImpact Flights::impact(long long index) const {
  model::require_impact("motion", index, impact_count(end()), end());
  const auto instant_of_impact = instant(index);
  const auto limit = limits(index);
  const auto kinematics = [this](const States& states) {
    const auto n = dof();
    Kinematics k{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto& mass = states[std::size_t(j)];
      k.u[j] = mass.u.nearest();
      k.v[j] = mass.v.nearest();
      k.a[j] = mass.a.nearest();
    }
    return k;
  };
  const auto energy = [&](const Kinematics& k) {
    const auto& s = problem_.system;
    const double stored = s.nonlinear ? s.nonlinear->potential(k.u) : 0.0;
    return 0.5 * (k.v.dot(s.mass * k.v) + k.u.dot(s.stiffness * k.u)) + stored;
  };
  model::MotionImpact hit;
  hit.index = index;
  hit.t = instant_of_impact.nearest();
  const double reach = instant_of_impact.nearest_error();
  hit.when = {hit.t - reach, hit.t + reach};
  hit.before = kinematics(limit.before);
  hit.after = kinematics(limit.after);
  hit.impulse = limit.impulse.nearest();
  hit.energy_before = energy(hit.before);
  hit.energy_after = energy(hit.after);
  return hit;
}

}  // namespace clackers::exact
