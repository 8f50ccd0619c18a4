#include "clackers/exact/bodies/string_over_point.hpp"

namespace clackers::exact {

using model::Side;
using numerics::Bounded, numerics::narrowed, numerics::Wide, numerics::WideReal;

StringOverPoint::StringOverPoint(const StringOverPointParameters& p)
    : p_(p),
      speed_(sqrt(Wide(p.T) / Wide(p.rho))),
      tau_(Wide(0.5) * Wide(p.L) / speed_),
      force_(Wide(4.0) * Wide(p.T) * Wide(p.H) / Wide(p.L)),
      falls_(Wide(1.0) - Wide(p.share)),
      period_(Wide(3.0) - Wide(p.share)) {}

auto StringOverPoint::phase(const Wide& s) const -> Phase {
  const WideReal k = floor(s.value / period_.value);
  return {s - Wide(k, 0) * period_, k};
}

double StringOverPoint::wave(const Wide& s, Side side, const WideReal& slack) const {
  const auto now = phase(s);
  const WideReal shift = now.s.error + period_.error + slack,
                 there = now.s.value + (side == Side::right ? shift : -shift);
  return there >= period_.value || (there >= 0 && there < falls_.value) ? -1.0 : 1.0;
}

Wide StringOverPoint::fallen(const Wide& s) const {
  const auto now = phase(s);
  return Wide(now.before, 0) * falls_ + min(now.s, falls_);
}

auto StringOverPoint::at(std::size_t, double x, double t, Side side) const -> Point {
  const auto part = Wide(2.0) * Wide(x) / Wide(p_.L), now = Wide(t) / tau_;
  const auto out = now - part, in = now + part - Wide(2.0);
  const auto u = Wide(p_.H) * (Wide(1.0) - part - fallen(out) + fallen(in));
  const auto slack = WideReal(half_spacing(t)) / tau_.value;
  double o = wave(out, side, slack), a = -wave(in, side, slack);
  if (t == 0.0 && side == Side::left) o = 1.0, a = -1.0;  // held
  return {narrowed(u), narrowed(Wide(0.5 * (o + a)) * Wide(p_.H) / tau_),
          narrowed(Wide(a - o) * Wide(p_.T) * Wide(p_.H) / Wide(p_.L))};
}

Bounded StringOverPoint::force(double t, Side side) const {
  const auto now = Wide(t) / tau_;
  const auto slack = WideReal(half_spacing(t)) / tau_.value;
  // What arrives is what left 2 tau before, with the opposite sign.
  const bool touches = wave(now, side, slack) > 0.0 && wave(now - Wide(2.0), side, slack) > 0.0;
  return touches ? contact_force() : Bounded(0.0);
}

Bounded StringOverPoint::impulse(double t, Side) const {
  const auto now = phase(Wide(t) / tau_);
  const auto contact = Wide(2.0) - falls_;
  const auto touched = Wide(now.before, 0) * contact + positive_part(min(now.s - falls_, contact));
  return narrowed(force_ * tau_ * touched);
}

// Each point moves with 0 or H/tau, and is inclined by 2 H/L where it does not.
auto StringOverPoint::energy(double t) const -> Energy {
  const auto s = phase(Wide(t) / tau_).s, rest = period_ - s;
  const auto moves = positive_part(min(min(s, rest), min(falls_, abs(s - rest))));
  const auto all = Wide(2.0) * Wide(p_.T) * Wide(p_.H) * Wide(p_.H) / Wide(p_.L);
  return {narrowed(all * moves), narrowed(all * (Wide(1.0) - moves)), 0.0};
}

}  // namespace clackers::exact
