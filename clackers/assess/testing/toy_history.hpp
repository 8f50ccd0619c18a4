#pragma once

#include <cmath>
#include <numbers>
#include <optional>

#include "clackers/assess/testing/toy_motion.hpp"
#include "clackers/model/trajectory.hpp"

// Histories of ToyMotion with errors made on purpose, for tests.
namespace clackers::assess {

/// What is wrong with a history of ToyMotion.
struct ToyFlaws {
  double end = 10.0;         ///< [s]
  double h = 0.01;           ///< between rows [s]
  double delay = 0.0;        ///< of every impact: each flight goes on through it [s]
  double smear = 0.0;        ///< time that a velocity takes from one limit to the other [s]
  double stretch = 1.0;      ///< of time: periods are this much longer
  bool reports = true;       ///< impacts are reported, with both limits
  bool knows_limits = true;  ///< false: reported with their times alone
};

/// Flight k of ToyMotion at phase x, for any x.
inline double toy_u(int k, double x) { return (k % 2 == 0 ? 1.0 : -1.0) * std::cos(x); }
inline double toy_v(int k, double x) { return (k % 2 == 0 ? -1.0 : 1.0) * std::sin(x); }

inline model::Trajectory toy_history(const ToyFlaws& flaws) {
  model::Trajectory made;
  made.dof = 2;
  if (flaws.reports) made.impacts.emplace();
  const double pi = std::numbers::pi;
  const auto instant = [&](int k) { return (k + 0.5) * pi * flaws.stretch + flaws.delay; };
  int flight = 0;
  const auto steps = std::lround(flaws.end / flaws.h);
  for (long i = 0; i <= steps; ++i) {
    const double t = i == steps ? flaws.end : double(i) * flaws.h;
    for (; instant(flight) <= t; ++flight) {
      const double at = instant(flight), x = at / flaws.stretch;
      if (!flaws.reports) continue;
      model::Impact impact{
          .t = at, .contact = 0, .u = {}, .v_before = {}, .v_after = {}, .impulse = 2.0};
      if (flaws.knows_limits) {
        impact.u = {toy_u(flight, x), -0.5 * toy_u(flight, x)};
        impact.v_before = {toy_v(flight, x), -0.5 * toy_v(flight, x)};
        impact.v_after = {toy_v(flight + 1, x), -0.5 * toy_v(flight + 1, x)};
      }
      made.impacts->push_back(impact);
    }
    const double x = t / flaws.stretch;
    double u = toy_u(flight, x), v = toy_v(flight, x) / flaws.stretch;
    const double late = flight > 0 ? t - instant(flight - 1) : flaws.smear;
    if (late < flaws.smear) v *= 2.0 * late / flaws.smear - 1.0;
    made.t.push_back(t);
    made.u.insert(made.u.end(), {u, -0.5 * u});
    made.v.insert(made.v.end(), {v, -0.5 * v});
  }
  return made;
}

}  // namespace clackers::assess
