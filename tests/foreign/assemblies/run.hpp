#pragma once

#include <algorithm>

#include "../printed.hpp"
#include "steps.hpp"

// Runs through impacts of any number of contacts, and the faults of what is printed.
namespace foreign::assemblies {

/// Newton's law of the active contacts at once, with the faults of `o`, at the impact `number`.
inline void apply_impacts(const Problem& p, const Options& o, Row& x,
                          const std::vector<std::size_t>& active, int number) {
  double factor = o.number("impulse", 1.0);
  if (number == o.number("at", 0.0)) factor *= o.number("impulse-at", 1.0);
  const auto impulses = [&](const std::vector<std::size_t>& contacts) {
    Matrix inertia;
    Vector right;
    for (const auto c : contacts) {
      inertia.emplace_back();
      for (const auto d : contacts)
        inertia.back().push_back(dot(p.contacts[c].direction, solve(p.M, p.contacts[d].direction)));
      const double closing = -p.speed(c, x.v);
      const double eta = p.contacts[c].eta - o.number("eta-slope", 0.0) * closing;
      right.push_back(factor * (1.0 + eta) * closing);
    }
    const Vector P = solve(inertia, right);
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const Vector& direction = p.contacts[contacts[k]].direction;
      Vector jump = P[k] * solve(p.M, direction);
      const double whole = dot(direction, jump);
      if (o.has("impulse-on-one") || o.has("wall"))
        for (std::size_t i = 0; i < jump.size(); ++i)
          if (direction[i] < 0.0) jump[i] = 0.0;
      x.v = x.v + (o.has("wall") ? whole / dot(direction, jump) : 1.0) * jump;
    }
  };
  if (o.has("one-after-another")) {
    for (const auto c : active)
      if (p.speed(c, x.v) < 0.0) impulses({c});
  } else {
    impulses(active);
  }
  if (!o.has("stale")) x.a = p.acceleration(x.u, x.v, x.t);
}

/// The part of a step within which contacts belong to one impact: large where they share masses, so
/// that an integrator's own error of their instants separates none.
inline double togetherness(const Problem& p) {
  for (std::size_t c = 0; c < p.contacts.size(); ++c)
    for (std::size_t d = 0; d < c; ++d)
      if (dot(p.contacts[c].direction, solve(p.M, p.contacts[d].direction)) != 0.0) return 0.7;
  return 0.05;
}

/// n steps of h; impacts located on the step map, or applied at the end of the step. Contacts that
/// are nearly closed where the first one closes belong to the same impact.
inline std::vector<Row> run(Problem p, const Options& o, double h, long n) {
  const Map step = make_map(o);
  const bool at_end = o.text("contact", "exact") == "end-of-step";
  const double together = togetherness(p);
  std::vector<Row> rows;
  Row x{0.0, p.u0, p.v0, p.acceleration(p.u0, p.v0, 0.0)};
  if (o.has("a0-zero")) x.a = Vector(p.u0.size());
  rows.push_back(x);
  std::vector<bool> armed(p.contacts.size());
  for (std::size_t c = 0; c < armed.size(); ++c) armed[c] = p.gap(c, x.u) > 1e-12;
  int number = 0;
  for (long i = 1; i <= n; ++i) {
    if (o.has("load-held")) p.hold = x.t;
    for (double left = h; left > 0.0;) {
      Row y = step(p, x, left);
      std::vector<std::size_t> crossed, active;
      for (std::size_t c = 0; c < armed.size(); ++c)
        if (armed[c] && p.gap(c, y.u) < 0.0) crossed.push_back(c);
      if (!crossed.empty() && !at_end) {
        const auto nearest = [&](double at) {
          const Vector u = step(p, x, at).u;
          double least = p.gap(crossed[0], u);
          for (const auto c : crossed) least = std::min(least, p.gap(c, u));
          return least;
        };
        const double tau = bisect(nearest, left, 0.0);
        y = step(p, x, tau);
        left -= tau;
      } else {
        left = 0.0;
      }
      for (std::size_t c = 0; c < armed.size(); ++c) {
        const double closing = -p.speed(c, y.v);
        if (!crossed.empty() && armed[c] && closing > 0.0 && p.gap(c, y.u) < together * h * closing)
          active.push_back(c);
      }
      if (!active.empty() && ++number != o.number("miss", 0.0)) {
        if (o.has("jumps")) rows.push_back(y);
        apply_impacts(p, o, y, active, number);
        if (o.has("jumps")) rows.push_back(y);
      }
      for (const auto c : active) armed[c] = false;
      x = y;
      if (left == 0.0)
        for (std::size_t c = 0; c < armed.size(); ++c)
          if (p.gap(c, x.u) > 0.0) armed[c] = true;
    }
    x.t = h * static_cast<double>(i);
    rows.push_back(x);
  }
  return rows;
}

/// The faults of what is printed: times, units, noise, the end.
inline void spoil(std::vector<Row>& rows, const Problem& p, const Options& o, double h) {
  const double late = o.number("late-seconds", 0.0) + h * o.number("late-steps", 0.0),
               unit = o.number("unit", 1.0), amplitude = o.number("noise", 0.0),
               drift = o.number("drift", 0.0), offset = o.number("offset", 0.0);
  unsigned long long count = static_cast<unsigned long long>(rows.size()) << 32;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (Vector* values : {&rows[i].u, &rows[i].v})
      for (double& value : *values) value = unit * value + amplitude * noise(++count);
    rows[i].u[0] += drift * rows[i].t + (i > 0 ? offset : 0.0);
    rows[i].t = (rows[i].t + late) * o.number("time-unit", 1.0);
  }
  const double end = o.number("until", 1.0) * p.end * o.number("time-unit", 1.0) * (1.0 + 1e-12);
  while (rows.size() > 1 && rows.back().t > end) rows.pop_back();
}

/// The rows that the solver of these words prints, with t first and u and v of each mass.
inline std::vector<Vector> printed(const Options& o) {
  Problem p = read_problem(o.text("problem", ""));
  const long n = std::lround(o.number("n", 1000.0));
  const double h = p.end / static_cast<double>(n);
  change(p, o, h);
  auto rows = run(p, o, h, n);
  spoil(rows, p, o, h);
  std::vector<Vector> table;
  for (const auto& row : rows) {
    table.push_back({row.t});
    for (std::size_t i = 0; i < row.u.size(); ++i) {
      table.back().push_back(row.u[i]);
      if (!o.has("no-velocities")) table.back().push_back(row.v[i]);
    }
  }
  return table;
}

}  // namespace foreign::assemblies
