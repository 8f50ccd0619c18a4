#pragma once

#include <algorithm>
#include <vector>

#include "integrators.hpp"

// Runs of a solver with impacts: the ways in which programs of others treat contact.
namespace foreign {

struct History {
  std::vector<State> rows;     ///< at the times that are printed
  std::vector<State> nodes;    ///< rows, and both limits of each impact
  std::vector<State> impacts;  ///< just after each impact
};

/// Newton's impact law with the faults of `o`, at the impact `number` (from 1). `h` is the step of
/// contacts at step ends, where the masses overlap.
inline void apply_impact(System& s, const Options& o, State& x, int number, double h = 1.0) {
  const double closing = s.speed(x.v), overlap = std::max(0.0, -s.gap(x.u));
  const Vec w = solve(s.M, s.normal);
  double eta = s.eta;
  if (-closing < o.number("bounces-above", 0.0)) eta = 0.0;
  if (overlap > -0.5 * h * closing) eta -= o.number("eta-lost-late", 0.0);
  double impulse = -(1.0 + eta) * closing / dot(s.normal, w) * o.number("impulse", 1.0);
  impulse += o.number("pushed-out", 0.0) * overlap / h / dot(s.normal, w);
  if (number == o.number("at", 0.0)) impulse *= o.number("impulse-at", 1.0);
  if (o.has("equal-masses")) {  // exchanges the velocities whatever the masses
    std::swap(x.v.x, x.v.y);
  } else {
    x.v = x.v + impulse * w;
  }
  if (o.has("c-after") && number == 1) s.C = o.number("c-after", 1.0) * s.C;
  x.h_before = 0.0;
  if (!o.has("stale")) x.a = s.acceleration(x.u, x.v, false);
}

inline double hermite(double y0, double d0, double y1, double d1, double h, double tau) {
  const double z = tau / h, z2 = z * z, z3 = z2 * z;
  return (2 * z3 - 3 * z2 + 1) * y0 + (z3 - 2 * z2 + z) * h * d0 + (3 * z2 - 2 * z3) * y1 +
         (z3 - z2) * h * d1;
}
inline Vec hermite(Vec y0, Vec d0, Vec y1, Vec d1, double h, double tau) {
  return {hermite(y0.x, d0.x, y1.x, d1.x, h, tau), hermite(y0.y, d0.y, y1.y, d1.y, h, tau)};
}

/// Bisection of a function that is positive at 0 and negative at h, to a bracket of `width`, whose
/// `share` is returned: 1/2 its middle, 1 its end.
double bisect(auto f, double h, double width, double share = 0.5) {
  double low = 0.0, high = h;
  while (high - low > width) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (f(middle) > 0.0 ? low : high) = middle;
  }
  return low + share * (high - low);
}

/// The state at the impact inside a step of `h` from x to y, located as the solver does it.
inline State locate(const System& s, const Options& o, const Step& step, const State& x,
                    const State& y, double h, double& tau) {
  const std::string how = o.text("contact", "exact");
  const auto guard = [&](Vec u) { return o.has("detect-u1") ? u.x : s.gap(u); };
  State z = x;
  if (how == "linear") {
    tau = h * guard(x.u) / (guard(x.u) - guard(y.u));
    z.u = x.u + tau / h * (y.u - x.u);
    z.v = x.v + tau / h * (y.v - x.v);
  } else if (how == "linear-time") {
    tau = h * guard(x.u) / (guard(x.u) - guard(y.u));
    z = step(s, x, tau);
  } else if (how == "hermite") {
    const auto u = [&](double at) { return hermite(x.u, x.v, y.u, y.v, h, at); };
    tau = bisect([&](double at) { return guard(u(at)); }, h, 0.0);
    z.u = u(tau);
    z.v =
        hermite(x.v, s.acceleration(x.u, x.v, false), y.v, s.acceleration(y.u, y.v, false), h, tau);
  } else {  // on the step map
    tau = bisect([&](double at) { return guard(step(s, x, at).u); }, h,
                 o.number("event-tolerance", 0.0), o.number("event-share", 0.5));
    z = step(s, x, tau);
  }
  return z;
}

/// Impacts located within steps, reversed at an end of the step, or ignored; or a penalty spring.
inline History run_steps(System s, const Options& o, double h, long n) {
  const Step step = make_step(o);
  const std::string how = o.text("contact", "exact");
  const bool at_end = how == "end-of-step", at_start = how == "start-of-step",
             at_next = how == "next-step";
  const bool rigid = s.contact && s.spring == 0.0;
  const double missed = o.number("miss", 0.0);
  const auto guard = [&](Vec u) { return o.has("detect-u1") ? u.x : s.gap(u); };
  const auto single = [&](State& x) {
    if (!o.has("single-state")) return;
    for (double* p : {&x.u.x, &x.u.y, &x.v.x, &x.v.y, &x.a.x, &x.a.y}) *p = static_cast<float>(*p);
  };
  History out;
  State x;
  x.u = s.u0;
  x.v = s.v0;
  if (!o.has("a0-zero")) x.a = s.acceleration(x.u, x.v, false);
  out.rows.push_back(x);
  out.nodes.push_back(x);
  bool armed = true, waiting = false;
  int number = 0;
  for (long i = 1; i <= n; ++i) {
    double left = h;
    while (left > 0.0) {
      if (s.spring > 0.0) {
        const double gap = s.gap(x.u);
        if (s.release == 0.0 || gap < 0.0) x.closed = gap < 0.0;
        if (s.release > 0.0 && gap > s.release) x.closed = false;
      }
      State y = step(s, x, left);
      const bool crossed = rigid && armed && guard(y.u) < 0.0;
      if (crossed && ++number == missed) {
        armed = false;
      } else if (crossed && at_next && !waiting) {
        --number;
        waiting = true;
      } else if (crossed && (at_end || at_next)) {
        waiting = false;
        if (s.speed(y.v) < 0.0) {
          apply_impact(s, o, y, number, h);
          out.impacts.push_back(y);
          out.impacts.back().t = h * static_cast<double>(i);
        }
      } else if (crossed && at_start) {
        if (s.speed(x.v) < 0.0) {
          apply_impact(s, o, x, number);
          out.impacts.push_back(x);
          out.impacts.back().t = h * static_cast<double>(i - 1);
          y = step(s, x, left);
        }
      } else if (crossed) {
        double tau = 0.0;
        State z = locate(s, o, step, x, y, left, tau);
        z.t = h * static_cast<double>(i) - left + tau;
        out.nodes.push_back(z);
        const double t = z.t;
        apply_impact(s, o, z, number);
        z.t = t;
        single(z);
        out.nodes.push_back(z);
        out.impacts.push_back(z);
        x = z;
        left -= tau;
        armed = false;
        continue;
      }
      x = y;
      left = 0.0;
      if (guard(x.u) > 0.0) armed = true;
    }
    x.t = h * static_cast<double>(i);
    single(x);
    out.rows.push_back(x);
    out.nodes.push_back(x);
  }
  return out;
}

/// A full step begins at each impact, so that rows leave the grid; the last step ends at the end.
inline History run_restarted(System s, const Options& o, double h) {
  const Step step = make_step(o);
  History out;
  State x;
  x.u = s.u0;
  x.v = s.v0;
  x.a = s.acceleration(x.u, x.v, false);
  out.rows.push_back(x);
  bool armed = true;
  double base = 0.0;
  for (long since = 1; x.t < s.end;) {
    const double t = std::min(base + h * static_cast<double>(since), s.end), left = t - x.t;
    State y = step(s, x, left);
    y.t = t;
    if (s.contact && armed && s.gap(y.u) < 0.0) {
      double tau = 0.0;
      State z = locate(s, o, step, x, y, left, tau);
      z.t = x.t + tau;
      out.rows.push_back(z);
      apply_impact(s, o, z, static_cast<int>(out.impacts.size()) + 1);
      out.rows.push_back(z);
      out.impacts.push_back(z);
      base = z.t;
      since = 1;
      armed = false;
      x = z;
      continue;
    }
    if (s.gap(y.u) > 0.0) armed = true;
    out.rows.push_back(y);
    x = y;
    ++since;
  }
  out.nodes = out.rows;
  return out;
}

}  // namespace foreign
