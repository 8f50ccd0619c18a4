#include "clackers/exact/bodies/bar_between_stops.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::exact {

using model::Side;
using numerics::Bounded;

BarBetweenStops::BarBetweenStops(const BarBetweenStopsParameters& p)
    : p_(p),
      wave_(BarContact::Wave::of(p.bar)),
      start_(Bounded(p.d) / Bounded(p.V)),
      contact_(Bounded(2.0) * wave_.transit),
      half_(Bounded(p.D) / Bounded(p.V) + contact_) {}

auto BarBetweenStops::phase(double t) const -> Phase {
  const auto s = Bounded(t) - start_;
  const double k = std::max(0.0, double(std::floor(s.value / half_.value)));
  return {s - Bounded(k) * half_, k};
}

bool BarBetweenStops::is_after(const Bounded& s, const Bounded& front, double t, Side side) {
  const auto since = s - front;
  if (std::abs(since.value) <= since.error + half_spacing(t)) return side == Side::right;
  return since.value > 0.0L;
}

auto BarBetweenStops::at(std::size_t, double x, double t, Side side) const -> Point {
  const auto now = phase(t);
  const auto& s = now.s;
  const bool is_left = std::fmod(now.before, 2.0) == 0.0;
  const Bounded V = p_.V, late = Bounded(is_left ? x : p_.bar.L - x) / wave_.speed,
                sign = is_left ? 1.0 : -1.0;
  const auto leaves = contact_ - late;
  const bool held = is_after(s, late, t, side), left = is_after(s, leaves, t, side);
  Bounded moved = -V * s;  // since the stop was touched, towards it negative
  if (s.value > leaves.value)
    moved = V * (s - contact_);
  else if (s.value > late.value)
    moved = -V * late;
  const Bounded v = left ? 1.0 : held ? 0.0 : -1.0;
  const auto base = is_left ? -Bounded(p_.d) : Bounded(p_.D) - Bounded(p_.d);
  return {base + sign * moved, sign * v * V,
          held && !left ? -(Bounded(p_.bar.rho) * wave_.speed * V) : Bounded(0.0)};
}

Bounded BarBetweenStops::force(double t, Side side) const {
  const auto s = phase(t).s;
  const bool touches = is_after(s, 0.0, t, side) && !is_after(s, contact_, t, side);
  return touches ? wave_.impedance * Bounded(p_.V) : Bounded(0.0);
}

Bounded BarBetweenStops::impulse(double t, Side) const {
  const auto now = phase(t);
  return wave_.impedance * Bounded(p_.V) *
         (Bounded(now.before) * contact_ + positive_part(min(now.s, contact_)));
}

auto BarBetweenStops::energy(double t) const -> Energy {
  const auto half = Bounded(0.5) * wave_.impedance * Bounded(p_.V) * Bounded(p_.V);
  // The front's way to the end that it started from.
  const auto s = phase(t).s, held = positive_part(min(s, contact_ - s));
  return {half * (wave_.transit - held), half * held, 0.0};
}

}  // namespace clackers::exact
