#pragma once

#include <algorithm>

#include "clackers/exact/orbit/formulas.hpp"

namespace clackers::exact {

/// Impacts of an oblique disk: up to `last` one by one; those before the slip ends, last + 1 for all. `proven` unless
/// 256 bits leave open where the slip ends.
struct DiskCounts {
  long long last = 0, slides = 0;
  bool proven = true;
};

/// Flight k begins with impact k up to `last`; then come slip on the floor, if only for an instant, and rolling. Closed
/// sums of geometric series: docs/manual/explanation/derivations/friction.md.
template <class Real>
struct DiskFormulas {
  ObliqueDiskParameters p;
  DiskCounts counts;
  Real V, first, once;  // once = 1 - eta
  Real slip, more;      // at the start; what an impulse takes of it: 1 + 1/beta times
  Real friction, loss;  // lost at the first impact while it slides, and in all when it rolls
  Real left;            // of the slip's size if friction acts at all impacts

  DiskFormulas() = default;
  DiskFormulas(const ObliqueDiskParameters& p_, const DiskCounts& counts_)
      : p(p_), counts(counts_), once(Real(1.0) - Real(p.eta)) {
    const Real v0 = p.v0, g = p.g, sign = is_backward() ? -1.0 : 1.0;
    V = sqrt(v0 * v0 + Real(2.0) * g * Real(p.h0));
    first = (v0 + V) / g;
    slip = Real(p.vx0) + Real(p.w0);
    more = Real(1.0) + Real(1.0) / Real(p.beta);
    friction = sign * Real(p.mu) * (Real(1.0) + Real(p.eta)) * V;
    loss = slip / more;
    left = sign * (slip - more * friction / once);
  }

  bool is_backward() const { return p.vx0 < -p.w0; }
  /// Seconds of slip on the floor.
  Real slip_end() const {
    return counts.slides > counts.last ? left / (Real(p.mu) * Real(p.g) * more) : Real(0.0);
  }
  /// Of eta; 0 after the last.
  Real power(long long k) const {
    if (k > counts.last) return 0.0;
    Real result = 1.0, square = p.eta;
    for (; k > 0; k /= 2, square = square * square)
      if (k % 2 == 1) result = result * square;
    return result;
  }
  Real rest() const { return first + Real(2.0) * V / Real(p.g) * Real(p.eta) / once; }
  Real instant(long long k) const {
    if (k == 0) return 0.0;
    if (k > counts.last) return k > counts.last + 1 ? rest() + slip_end() : rest();
    return first + Real(2.0) * V / Real(p.g) * (Real(p.eta) - power(k)) / once;
  }
  /// Of the velocity along the floor at the beginning of flight k.
  Real lost(long long k) const {
    if (k == 0) return 0.0;
    return k <= counts.slides ? friction * (Real(1.0) - power(k)) / once : loss;
  }
  StatesOf<Real> state(long long k, const Real& s) const {
    const Real g = k <= counts.last ? p.g : 0.0;
    const MassStateOf<Real> height =
        k == 0 ? MassStateOf<Real>{p.h0, p.v0, -g} : MassStateOf<Real>{0.0, power(k) * V, -g};
    StatesOf<Real> now{{along(k, 1.0, p.vx0), height, along(k, Real(1.0) / Real(p.beta), p.w0)}};
    for (auto& [u, v, a] : now) {
      u = u + s * (v + Real(0.5) * a * s);
      v = v + a * s;
    }
    return now;
  }
  LimitsOf<Real> limits(long long k) const {
    LimitsOf<Real> limit;
    for (const bool after : {false, true}) {
      const long long flight = after ? k : k - 1;
      const Real speed = power(flight) * V;
      const auto now = state(flight, 0.0), there = state(k, 0.0);
      auto& states = after ? limit.after : limit.before;
      states = now;
      for (const std::size_t i : {0U, 2U}) states[i].u = there[i].u;
      states[1] = {0.0, after ? speed : -speed, now[1].a};
    }
    limit.impulse = (Real(1.0) + Real(p.eta)) * power(k - 1) * V;
    return limit;
  }
  /// Of an impact, where the height is 0.
  Real energy(const StatesOf<Real>& x) const {
    return (x[0].v * x[0].v + x[1].v * x[1].v + Real(p.beta) * x[2].v * x[2].v) * 0.5;
  }
  bool turns(std::size_t, long long, double) const { return false; }

 private:
  // What the loss amounts to [m].
  Real behind(long long k) const {
    if (k == 0) return 0.0;
    if (k > counts.last + 1)
      return behind(counts.last + 1) +
             (lost(counts.last + 1) + loss) * Real(0.5) * slip_end();  // evenly decelerated
    const Real eta = p.eta, until = power(k),
               sliding = k <= counts.slides ? until : eta * power(counts.slides);
    const Real some = (eta - sliding) / once,
               twice = (eta * eta - sliding * sliding) / (Real(1.0) - eta * eta);
    return Real(2.0) * V / Real(p.g) * (friction * (some - twice) + loss * (sliding - until)) /
           once;
  }
  MassStateOf<Real> along(long long k, const Real& share, double velocity) const {
    const Real force =
        k == counts.last + 1 ? share * Real(is_backward() ? p.mu : -p.mu) * Real(p.g) : Real(0.0);
    return {Real(velocity) * instant(k) - share * behind(k), Real(velocity) - share * lost(k),
            force};
  }
};

}  // namespace clackers::exact
