#pragma once

#include <cstdint>
#include <vector>

#include "adaptive.hpp"
#include "time_stepping.hpp"

// What a solver prints of its run, with the faults of times, units, signs and velocities.
namespace foreign {

/// Rows on a common grid, interpolated between the solver's own steps.
inline std::vector<State> resampled(const History& history, const Options& o) {
  const auto& nodes = o.text("nodes", "steps") == "events" ? history.nodes : history.rows;
  const bool cubic = o.text("resample-by", "linear") == "cubic";
  const double dt = o.number("resample", 0.001);
  std::vector<State> rows;
  std::size_t i = 0;
  const long last = std::lround(nodes.back().t / dt);
  for (long k = 0; k <= last; ++k) {
    const double t = static_cast<double>(k) * dt;
    while (i + 2 < nodes.size() && nodes[i + 1].t <= t) ++i;
    const State &x = nodes[i], &y = nodes[i + 1];
    const double h = y.t - x.t, tau = t - x.t;
    State row;
    row.t = t;
    if (cubic) {
      row.u = hermite(x.u, x.v, y.u, y.v, h, tau);
      row.v = hermite(x.v, x.a, y.v, y.a, h, tau);
    } else {
      row.u = x.u + tau / h * (y.u - x.u);
      row.v = x.v + tau / h * (y.v - x.v);
    }
    rows.push_back(row);
  }
  return rows;
}

/// A number in [-1, 1) from a counter; the same on every machine.
inline double noise(unsigned long long i) {
  i = (i + 0x9e3779b97f4a7c15ULL) * 0xbf58476d1ce4e5b9ULL;
  i = (i ^ (i >> 27)) * 0x94d049bb133111ebULL;
  i ^= i >> 31;
  return static_cast<double>(i >> 11) * 0x1p-52 - 1.0;
}

/// The faults of what is printed: times, units, signs, velocities, noise.
inline void spoil(std::vector<State>& rows, const System& s, const Options& o, double h) {
  if (o.has("half-velocities"))
    for (std::size_t i = o.has("start-right") ? 1 : 0; i < rows.size(); ++i)
      rows[i].v = rows[i].v + 0.5 * h * o.number("half-velocities", 1.0) * rows[i].a;
  if (o.has("nan-above") && h > o.number("nan-above", 0.0))
    for (std::size_t i = rows.size() / 2; i < rows.size(); ++i)
      rows[i].u = rows[i].v = {std::nan(""), std::nan("")};
  if (o.has("difference-velocities"))
    for (std::size_t i = rows.size() - 1; i > 0; --i)
      rows[i].v = (1.0 / (rows[i].t - rows[i - 1].t)) * (rows[i].u - rows[i - 1].u);
  const double all = o.number("unit", 1.0), u = all * o.number("u-unit", 1.0),
               v = all * o.number("v-unit", 1.0);
  const std::string flip = o.text("flip", "");
  const double first = flip == "all" || flip == "1" ? -1.0 : 1.0,
               second = flip == "all" || flip == "2" ? -1.0 : 1.0;
  const double amplitude = o.number("noise", 0.0);
  unsigned long long count = static_cast<unsigned long long>(rows.size()) << 32;
  float sum = 0.0F;
  const double late = o.number("late-seconds", 0.0) + h * o.number("late-steps", 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    State& x = rows[i];
    for (double* p : {&x.u.x, &x.u.y}) *p = *p * u + amplitude * noise(++count);
    for (double* p : {&x.v.x, &x.v.y}) *p = *p * v + amplitude * noise(++count);
    x.u.x += o.number("drift", 0.0) * x.t + (i > 0 ? o.number("offset", 0.0) : 0.0);
    x.u.x *= first;
    x.v.x *= first;
    x.u.y *= second;
    x.v.y *= second;
    if (o.text("exchange", "") == "all" || (o.text("exchange", "") == "after-start" && i > 0)) {
      std::swap(x.u.x, x.u.y);
      std::swap(x.v.x, x.v.y);
    }
    if (o.has("float-time")) {
      x.t = sum;
      sum += static_cast<float>(h);
    }
    if (!(o.has("start-on-time") && i == 0)) x.t = (x.t + late) * o.number("time-unit", 1.0);
    if (o.has("single-output"))
      for (double* p : {&x.u.x, &x.u.y, &x.v.x, &x.v.y, &x.a.x, &x.a.y})
        *p = static_cast<float>(*p);
  }
  const double end = o.number("until", 1.0) * s.end * o.number("time-unit", 1.0) * (1.0 + 1e-12);
  while (rows.size() > 1 && rows.back().t > end) rows.pop_back();
}

/// The rows that the solver of these words prints, n steps of h; its run goes to `history`.
inline std::vector<State> printed_rows(const System& s, const Options& o, double h, long n,
                                       History& history) {
  const std::string contact = o.text("contact", "exact");
  history = o.has("tolerance")
                ? run_adaptive(s, o, o.number("tolerance", 1e-6), o.number("spacing", 0.01))
            : contact == "moreau"   ? run_moreau(s, o, h, n)
            : o.has("restart-grid") ? run_restarted(s, o, h)
            : contact == "paoli"    ? run_paoli(s, o, h, n)
                                    : run_steps(s, o, h, n);
  if (o.has("internal-step")) {  // whatever h: rows show the last state of such steps
    const double own = o.number("internal-step", h);
    history = run_steps(s, o, own, std::lround(std::ceil(h * static_cast<double>(n) / own)));
    std::vector<State> shown;
    for (long i = 0; i <= n; ++i) {
      const double t = h * static_cast<double>(i);
      shown.push_back(history.rows[static_cast<std::size_t>(t / own * (1.0 + 1e-12))]);
      shown.back().t = t;
    }
    history.rows = shown;
  }
  auto rows = o.has("resample") ? resampled(history, o)
              : o.has("jumps")  ? history.nodes
                                : history.rows;
  spoil(rows, s, o, h);
  return rows;
}

}  // namespace foreign
