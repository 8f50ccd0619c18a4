#pragma once

#include <cmath>
#include <vector>

#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/model/trajectory.hpp"

// Histories made of a reference whose impacts are moved, for tests.
namespace clackers::measure {

struct ShiftedHistory {
  double step = 0.01;   ///< of the grid, which starts at 0 [s]
  double delay = 0.0;   ///< of every impact, 0 <= delay < time between impacts [s]
  bool limits = true;   ///< both limits of an impact as two rows with its time
  bool reports = true;  ///< impacts are reported, with all that is known of them
  bool velocities = true, accelerations = false;
};

/// The motion on a grid and at its end, seen through a clock that is late by `delay` at each impact
/// and straight between them (and right at t = 0): at time t it shows the true state at some t'
/// with |t - t'| <= delay.
inline model::Trajectory shifted(const model::Motion& reference, const ShiftedHistory& how) {
  model::Trajectory history;
  history.dof = reference.dof();
  if (how.reports) history.impacts.emplace();
  const auto add = [&](double t, const model::Kinematics& now) {
    history.t.push_back(t);
    for (Eigen::Index i = 0; i < now.u.size(); ++i) {
      history.u.push_back(now.u[i]);
      if (how.velocities) history.v.push_back(now.v[i]);
      if (how.accelerations) history.a.push_back(now.a[i]);
    }
  };
  const auto known = reference.impact_count(reference.end());
  const auto rows = std::llround(std::floor(reference.end() / how.step * (1.0 + 1e-12)));
  long long passed = 0, row = 0;
  double from = 0.0, true_from = 0.0, rate = 1.0;  // the impact before, on both clocks
  const auto seen = [&](double t) {
    return reference.at(std::min(true_from + rate * (t - from), reference.end()),
                        model::Side::left);
  };
  while (true) {
    const bool more = passed < known;
    const auto next = more ? reference.impact(passed + 1) : model::MotionImpact{};
    const double at = next.t + how.delay;
    rate = more ? (next.t - true_from) / (at - from) : 1.0;
    for (; row <= rows; ++row) {
      const double t = std::min(double(row) * how.step, reference.end());
      if (more && t >= at) break;
      add(t, seen(t));
    }
    if (!more || at > reference.end()) break;
    if (double(row) * how.step == at) ++row;
    if (how.limits) {
      add(at, next.before);
      add(at, next.after);
    }
    if (how.reports)
      history.impacts->push_back({at, next.contact, entries(next.before.u), entries(next.before.v),
                                  entries(next.after.v), next.impulse});
    from = at;
    true_from = next.t;
    ++passed;
  }
  if (history.t.back() < reference.end()) add(reference.end(), seen(reference.end()));
  return history;
}

}  // namespace clackers::measure
