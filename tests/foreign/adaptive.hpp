#pragma once

#include "simulate.hpp"

// Steps that error control chooses.
namespace foreign {

/// Dormand-Prince with a tolerance; rows every `spacing`, impacts located on the step map.
inline History run_adaptive(System s, const Options& o, double tolerance, double spacing) {
  Options rule = o;
  rule.values["method"] = "dopri5";
  const Step step = make_step(rule);
  const auto low = [](const System& system, const State& x, double h) {
    return runge_kutta_step(system, x, h, 7, dopri_a, dopri_low);
  };
  const bool resampled = o.has("hermite-output"), own_steps = o.has("own-steps");
  History out;
  State x;
  x.u = s.u0;
  x.v = s.v0;
  out.rows.push_back(x);
  const long rows = std::lround(s.end / spacing);
  long next = 1;
  double h = 1e-3;
  bool armed = true;
  while (next <= rows) {
    State y = step(s, x, h);
    const State z = low(s, x, h);
    const auto part = [&](double a, double b, double size) {
      const double scale =
          tolerance * (o.number("atol", 1e-3) + std::max(std::abs(a), std::abs(size)));
      return (a - b) / scale * ((a - b) / scale);
    };
    const double error = std::sqrt((part(y.u.x, z.u.x, x.u.x) + part(y.u.y, z.u.y, x.u.y) +
                                    part(y.v.x, z.v.x, x.v.x) + part(y.v.y, z.v.y, x.v.y)) /
                                   (2.0 * s.masses));
    const double factor = std::clamp(0.9 * std::pow(std::max(error, 1e-10), -0.2), 0.2, 5.0);
    if (error > 1.0) {
      h *= factor;
      continue;
    }
    double used = h;
    bool hit = s.contact && armed && s.gap(y.u) < 0.0;
    if (hit && o.has("event-linear")) {  // state and time on the line between two steps
      used = h * s.gap(x.u) / (s.gap(x.u) - s.gap(y.u));
      y.u = x.u + used / h * (y.u - x.u);
      y.v = x.v + used / h * (y.v - x.v);
    } else if (hit) {
      used = bisect([&](double at) { return s.gap(step(s, x, at).u); }, h,
                    o.number("event-tolerance", 0.0));
      y = step(s, x, used);
    }
    if (own_steps) {
      State row = y;
      row.t = x.t + used;
      out.rows.push_back(row);
      if (row.t >= s.end) break;
    }
    for (; next <= rows && static_cast<double>(next) * spacing <= x.t + used * (1.0 + 1e-14);
         ++next) {
      State row = step(s, x, static_cast<double>(next) * spacing - x.t);
      if (resampled) {
        row.u = hermite(x.u, x.v, y.u, y.v, used, static_cast<double>(next) * spacing - x.t);
        row.v = hermite(x.v, x.a, y.v, y.a, used, static_cast<double>(next) * spacing - x.t);
      }
      row.t = static_cast<double>(next) * spacing;
      if (!own_steps) out.rows.push_back(row);
    }
    y.t = x.t + used;
    if (hit) {
      apply_impact(s, o, y, static_cast<int>(out.impacts.size()) + 1);
      out.impacts.push_back(y);
      if (own_steps && o.has("jumps")) out.rows.push_back(y);
      armed = false;
    } else if (s.gap(y.u) > 0.0) {
      armed = true;
    }
    x = y;
    h *= factor;
    h = std::min(h, o.number("h-most", 0.2));
  }
  out.nodes = out.rows;
  return out;
}

}  // namespace foreign
