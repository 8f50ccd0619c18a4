#include "clackers/exact/bodies/bar_between_stops.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::exact {

using model::Side;
using numerics::Bounded;

BarBetweenStops::BarBetweenStops(const BarBetweenStopsParameters& p)
    : p_(p),
      tau_(Bounded(p.bar.L) * sqrt(Bounded(p.bar.rho) / Bounded(p.bar.E))),
      c_(sqrt(Bounded(p.bar.E) / Bounded(p.bar.rho))),
      z_(Bounded(p.bar.A) * sqrt(Bounded(p.bar.E) * Bounded(p.bar.rho))),
      start_(Bounded(p.d) / Bounded(p.V)),
      half_(Bounded(p.D) / Bounded(p.V) + Bounded(2.0) * tau_) {}

auto BarBetweenStops::phase(double t) const -> Phase {
  const auto s = Bounded(t) - start_;
  const double k = std::max(0.0, double(std::floor(s.value / half_.value)));
  return {s - Bounded(k) * half_, k, std::fmod(k, 2.0) == 0.0};
}

bool BarBetweenStops::is_after(const Bounded& s, const Bounded& front, double t, Side side) {
  const auto since = s - front;
  const double spacing = std::nextafter(t, INFINITY) - t;
  if (std::abs(since.value) <= since.error + 0.5L * spacing) return side == Side::right;
  return since.value > 0.0L;
}

Bounded BarBetweenStops::reach(const Bounded& s) const {
  const auto back = Bounded(2.0) * tau_ - s;
  const auto& way = s.value < back.value ? s : back;
  return {std::max(0.0L, way.value), std::max(s.error, back.error)};
}

auto BarBetweenStops::at(std::size_t, double x, double t, Side side) const -> Point {
  const auto [s, before, is_left] = phase(t);
  const Bounded V = p_.V, late = Bounded(is_left ? x : p_.bar.L - x) / c_,
                sign = is_left ? 1.0 : -1.0;
  const auto leaves = Bounded(2.0) * tau_ - late;
  const bool held = is_after(s, late, t, side), left = is_after(s, leaves, t, side);
  Bounded moved = -V * s;  // since the stop was touched, towards it negative
  if (s.value > leaves.value)
    moved = V * (s - Bounded(2.0) * tau_);
  else if (s.value > late.value)
    moved = -V * late;
  const Bounded v = left ? 1.0 : held ? 0.0 : -1.0;
  const auto base = is_left ? -Bounded(p_.d) : Bounded(p_.D) - Bounded(p_.d);
  return {base + sign * moved, sign * v * V,
          held && !left ? -(Bounded(p_.bar.rho) * c_ * V) : Bounded(0.0)};
}

Bounded BarBetweenStops::force(double t, Side side) const {
  const auto s = phase(t).s;
  const bool touches = is_after(s, 0.0, t, side) && !is_after(s, Bounded(2.0) * tau_, t, side);
  return touches ? z_ * Bounded(p_.V) : Bounded(0.0);
}

Bounded BarBetweenStops::impulse(double t) const {
  const auto now = phase(t);
  const auto twice = Bounded(2.0) * tau_;
  const auto& s = now.s.value < twice.value ? now.s : twice;
  return z_ * Bounded(p_.V) *
         (Bounded(now.before) * twice +
          Bounded(std::max(0.0L, s.value), std::max(now.s.error, twice.error)));
}

auto BarBetweenStops::energy(double t) const -> Energy {
  const auto half = Bounded(0.5) * z_ * Bounded(p_.V) * Bounded(p_.V);
  const auto held = reach(phase(t).s);
  return {half * (tau_ - held), half * held, 0.0};
}

}  // namespace clackers::exact
