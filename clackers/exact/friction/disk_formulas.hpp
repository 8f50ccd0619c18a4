#pragma once

#include <algorithm>

#include "clackers/exact/orbit/ball_formulas.hpp"

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
struct DiskFormulas : BallFormulas<Real> {
  using BallFormulas<Real>::ball, BallFormulas<Real>::V, BallFormulas<Real>::once;
  using BallFormulas<Real>::power, BallFormulas<Real>::rest;
  ObliqueDiskParameters p;
  DiskCounts counts;
  Real slip, more;      // at the start; what an impulse takes of it: 1 + 1/beta times
  Real friction, loss;  // lost at the first impact while it slides, and in all when it rolls
  Real left;            // of the slip's size if friction acts at all impacts

  DiskFormulas() = default;
  DiskFormulas(const ObliqueDiskParameters& p_, const DiskCounts& counts_)
      : BallFormulas<Real>(p_.height, counts_.last), p(p_), counts(counts_) {
    const Real sign = is_backward() ? -1.0 : 1.0;
    slip = Real(p.vx0) + Real(p.w0);
    more = Real(1.0) + Real(1.0) / Real(p.beta);
    friction = sign * Real(p.mu) * (Real(1.0) + Real(ball.eta)) * V;
    loss = slip / more;
    left = sign * (slip - more * friction / once);
  }

  long long last_flight() const { return counts.last + 2; }
  bool is_backward() const { return p.vx0 < -p.w0; }
  /// Seconds of slip on the floor.
  Real slip_end() const {
    return counts.slides > counts.last ? left / (Real(p.mu) * Real(ball.g) * more) : Real(0.0);
  }
  Real instant(long long k) const {
    const Real on_ground = BallFormulas<Real>::instant(k);
    return k > counts.last + 1 ? on_ground + slip_end() : on_ground;
  }
  /// Of the velocity along the floor at the beginning of flight k.
  Real lost(long long k) const {
    if (k == 0) return 0.0;
    return k <= counts.slides ? friction * (Real(1.0) - power(k)) / once : loss;
  }
  StatesOf<Real> state(long long k, const Real& s) const {
    const auto moved = [&](MassStateOf<Real> x) {
      return MassStateOf<Real>{x.u + s * (x.v + Real(0.5) * x.a * s), x.v + x.a * s, x.a};
    };
    return {{moved(along(k, 1.0, p.vx0)), this->height(k, s),
             moved(along(k, Real(1.0) / Real(p.beta), p.w0))}};
  }
  LimitsOf<Real> limits(long long k) const {
    const auto height = BallFormulas<Real>::limits(k);
    LimitsOf<Real> limit{state(k - 1, 0.0), state(this->following(k), 0.0), height.impulse};
    for (const std::size_t i : {0U, 2U}) limit.before[i].u = limit.after[i].u;
    limit.before[1] = height.before[0];
    limit.after[1] = height.after[0];
    return limit;
  }
  /// Of an impact, where the height is 0.
  Real energy(const StatesOf<Real>& x) const {
    return (x[0].v * x[0].v + x[1].v * x[1].v + Real(p.beta) * x[2].v * x[2].v) * 0.5;
  }

 private:
  // What the loss amounts to [m].
  Real behind(long long k) const {
    if (k == 0) return 0.0;
    if (k > counts.last + 1)
      return behind(counts.last + 1) +
             (lost(counts.last + 1) + loss) * Real(0.5) * slip_end();  // evenly decelerated
    const Real eta = ball.eta, until = power(k),
               sliding = k <= counts.slides ? until : eta * power(counts.slides);
    const Real some = (eta - sliding) / once,
               twice = (eta * eta - sliding * sliding) / (Real(1.0) - eta * eta);
    return this->unit * (friction * (some - twice) + loss * (sliding - until));
  }
  MassStateOf<Real> along(long long k, const Real& share, double velocity) const {
    const Real force = k == counts.last + 1
                           ? share * Real(is_backward() ? p.mu : -p.mu) * Real(ball.g)
                           : Real(0.0);
    return {Real(velocity) * instant(k) - share * behind(k), Real(velocity) - share * lost(k),
            force};
  }
};

}  // namespace clackers::exact
