#pragma once

#include "simulate.hpp"

// Time stepping: impacts at velocity or position level, without their instants.
namespace foreign {

/// Moreau-Jean theta method, contact predicted at half a step.
inline History run_moreau(const System& s, const Options& o, double h, long n) {
  const double theta = o.number("theta", 0.5);
  History out;
  State x;
  x.u = s.u0;
  x.v = s.v0;
  const Mat left = s.M + h * theta * s.C + h * h * theta * theta * s.K;
  const Vec w = solve(left, s.normal);
  for (long i = 0;; ++i) {
    x.t = h * static_cast<double>(i);
    x.a = s.acceleration(x.u, x.v, false);
    out.rows.push_back(x);
    if (i == n) break;
    Vec v = solve(left, s.M * x.v - h * (1.0 - theta) * (s.C * x.v) - h * (s.K * x.u) -
                            h * h * theta * (1.0 - theta) * (s.K * x.v));
    if (s.contact && s.gap(x.u + 0.5 * h * x.v) <= 0.0) {
      const double p = std::max(0.0, (-s.eta * s.speed(x.v) - s.speed(v)) / dot(s.normal, w));
      v = v + p * w;
      if (p > 0.0) out.impacts.push_back(x);
    }
    x.u = x.u + h * (theta * v + (1.0 - theta) * x.v);
    x.v = v;
  }
  out.nodes = out.rows;
  return out;
}

/// Paoli-Schatzman; velocities are central differences.
inline History run_paoli(const System& s, const Options&, double h, long n) {
  History out;
  const Vec a0 = s.acceleration(s.u0, s.v0, false);
  Vec before = s.u0 - h * s.v0 + 0.5 * h * h * a0, u = s.u0;
  const Mat D = 1.0 / (h * h) * s.M + 0.5 / h * s.C;
  const Vec w = solve(D, s.normal);
  for (long i = 0; i <= n; ++i) {
    Vec after = solve(D, 2.0 / (h * h) * (s.M * u) - s.K * u - 1.0 / (h * h) * (s.M * before) +
                             0.5 / h * (s.C * before));
    const double g = s.gap(after + s.eta * before) / (1.0 + s.eta);
    if (s.contact && g < 0.0) after = after + -(1.0 + s.eta) * g / dot(s.normal, w) * w;
    State x;
    x.t = h * static_cast<double>(i);
    x.u = u;
    x.v = 0.5 / h * (after - before);
    x.a = 1.0 / (h * h) * (after - 2.0 * u + before);
    out.rows.push_back(x);
    before = u;
    u = after;
  }
  out.nodes = out.rows;
  return out;
}

}  // namespace foreign
